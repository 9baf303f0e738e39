#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "atlas/law_without_runs.hpp"
#include "law/chosen_pair.hpp"
#include "law/range.hpp"

namespace granulaw {

using Json = nlohmann::ordered_json;

/// A state of the page, read and checked:
///   {"material": {"name", "density", "youngs_modulus", "poisson_ratio", "yield_stress", "hardening_modulus"},
///    "radius": m, "partner": "wall" | "like" | {"material": {...}, "radius": m}, "speed": m/s}
/// SI. yield_stress null or absent: elastic. A partner without a material is of the sphere's own, a partner without a radius
/// is a thick deformable wall.
struct Request
{
  LawMaterial first, second;  // second: without meaning at a rigid wall
  enum class Partner { rigid_wall, like, sphere, thick_wall } partner = Partner::rigid_wall;
  bool one_material = true;
  double radius = 0, radius2 = 0, speed = 0;

  bool has_rigid_wall() const { return partner == Partner::rigid_wall; }
  SceneSizes sizes() const
  {
    SceneSizes sizes;
    sizes.thick_walls = partner == Partner::thick_wall;
    if (partner == Partner::sphere) sizes.radius_ratio = std::clamp(std::max(radius / radius2, radius2 / radius), 1.0, largest_radius_ratio);
    return sizes;
  }
  PairAsked asked() const
  {
    PairAsked asked;
    asked.pair = first.name + ":" + (has_rigid_wall() ? std::string(wall_name) : second.name);
    asked.radius = radius;
    if (!has_rigid_wall()) asked.radius2 = radius2;
    return asked;
  }
  /// All that its law follows from.
  std::string key() const
  {
    const auto text = [](const LawMaterial& m) {
      return fmt::format("{} {} {} {} {} {} ", m.name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus);
    };
    const SceneSizes s = sizes();
    return fmt::format("{}{}{} {} {}", text(first), has_rigid_wall() ? std::string() : text(second), static_cast<int>(partner), s.radius_ratio, s.thick_walls);
  }
};

/// Throws Error with the sentence of `mpm`.
Request request_of(const Json& json);

double number_of(const Json& object, const char* key, const std::string& where);
double number_or(const Json& object, const char* key, const std::string& where, double otherwise);

/// Requirements of a bed of the request's bodies on a floor, by the functions of `mpm plan` and `mpm stretch`. Every contact
/// is at most as fast as the request's speed (--speed), the bed is `height` m high (--fill-height), gravity is 9.81 m/s^2.
/// Keys are those of the two commands' --json.
Json bed_json(const Atlas& atlas, const Request& request, double height);

/// Fits the yield stress to drop tests: the object of `mpm calibrate --json --fit yield_stress`.
///   {"data": "velocity_m_per_s,restitution\n...", "relative_sd": of an e without a standard deviation,
///    "material", "radius", "partner": as in a Request; the yield stress is not looked at}
Json drops_json(const Atlas& atlas, const Json& json);

}  // namespace granulaw
