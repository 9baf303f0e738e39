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

}  // namespace granulaw
