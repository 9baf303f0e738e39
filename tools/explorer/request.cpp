#include "request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "material_file/material_range.hpp"

namespace granulaw {

double number_of(const Json& object, const char* key, const std::string& where)
{
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) fail(where, fmt::format("the key '{}' is missing", key));
  if (!found->is_number()) fail(where, fmt::format("'{}' must be a number", key));
  return found->get<double>();
}

double number_or(const Json& object, const char* key, const std::string& where, double otherwise)
{
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? otherwise : number_of(object, key, where);
}

namespace {

LawMaterial material_of(const Json& object, const char* usual_name)
{
  if (!object.is_object()) fail("request", "'material' must be an object");
  LawMaterial m;
  m.name = object.value("name", usual_name);
  if (m.name == wall_name) fail("request", fmt::format("a material cannot be named '{}'", wall_name));
  const std::string where = fmt::format("[material.{}]", m.name);
  m.density = number_of(object, "density", where);
  m.youngs_modulus = number_of(object, "youngs_modulus", where);
  m.poisson_ratio = number_of(object, "poisson_ratio", where);
  m.yield_stress = number_or(object, "yield_stress", where, std::numeric_limits<double>::infinity());
  m.hardening_modulus = number_or(object, "hardening_modulus", where, 0);
  const auto where_of = [&](const char*) { return where; };
  check_elastic(m, where_of);
  check_yield_stress(m, where_of);
  if (m.yields())
    check_hardening(m, fmt::format("[material.{}.hardening]", m.name));
  else
    m.hardening_modulus = 0;
  return m;
}

}  // namespace

Request request_of(const Json& json)
{
  if (!json.is_object() || !json.contains("material")) fail("request", "the key 'material' is missing");
  Request r;
  r.first = r.second = material_of(json.at("material"), "body");
  r.radius = r.radius2 = number_of(json, "radius", "request");
  r.speed = number_of(json, "speed", "request");
  const Json partner = json.contains("partner") ? json.at("partner") : Json(wall_name);
  if (partner == wall_name) return r;
  if (partner == "like") {
    r.partner = Request::Partner::like;
    return r;
  }
  if (!partner.is_object()) fail("request", "'partner' cannot be used", partner.dump(), "\"wall\", \"like\" or {material, radius}");
  if (partner.contains("material") && !partner.at("material").is_null()) {
    r.one_material = false;
    r.second = material_of(partner.at("material"), "partner");
    if (r.second.name == r.first.name) r.second.name += "-2";
  }
  r.radius2 = number_or(partner, "radius", "partner", std::numeric_limits<double>::infinity());
  r.partner = std::isinf(r.radius2) ? Request::Partner::thick_wall : Request::Partner::sphere;
  return r;
}

}  // namespace granulaw
