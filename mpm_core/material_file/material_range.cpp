#include "material_file/material_range.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "material_file/plausible.hpp"

namespace granulaw {

namespace {

void check_solid(const WhereOfKey& where, const char* key, double value, const char* unit)
{
  require_positive(where(key), key, value, unit);
  check_plausible(where(key), key, key, value);
}

}  // namespace

void require_positive(const std::string& where, const std::string& key, double value, const std::string& unit)
{
  if (value > 0 && std::isfinite(value)) return;
  const std::string of_unit = unit.empty() ? "" : " " + unit;
  fail(where, fmt::format("'{}' is out of range", key), fmt::format("{:g}{}", value, of_unit),
       "over 0" + of_unit);
}

void check_elastic(const LawMaterial& m, const WhereOfKey& where)
{
  check_solid(where, "density", m.density, "kg/m^3");
  check_solid(where, "youngs_modulus", m.youngs_modulus, "Pa");
  if (!(m.poisson_ratio >= 0 && m.poisson_ratio < 0.4999))
    fail(where("poisson_ratio"), "'poisson_ratio' is out of range", fmt::format("{:g}", m.poisson_ratio),
         "0 to below 0.4999 (0.5 is incompressible: the solver needs a finite bulk modulus; 0.49 works)");
}

void check_yield_stress(const LawMaterial& m, const WhereOfKey& where)
{
  if (!m.yields() && !std::isnan(m.yield_stress)) return;
  check_solid(where, "yield_stress", m.yield_stress, "Pa");
  if (m.yield_stress > 0.1 * m.e_star())
    fail(where("yield_stress"), "'yield_stress' is out of range", fmt::format("{:g} Pa", m.yield_stress),
         fmt::format("up to a tenth of E* = E/(1-nu^2), {:.4g} Pa: where 'youngs_modulus' is lowered for the time step, "
                     "give the real one (docs/guide/plan.md#soften); without the key the body is elastic",
                     0.1 * m.e_star()));
}

void check_hardening(const LawMaterial& m, const std::string& where)
{
  if (!(m.hardening_modulus >= 0 && m.hardening_modulus <= m.youngs_modulus))
    fail(where, "'modulus' is out of range", fmt::format("{:g} Pa", m.hardening_modulus), "0 to youngs_modulus");
}

}  // namespace granulaw
