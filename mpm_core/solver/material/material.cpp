#include "solver/material/material.hpp"

#include <fmt/format.h>

#include <string>

#include "base/error.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

void require(bool ok, const char* where, const char* key, double found, const char* allowed)
{
  if (!ok) fail(where, fmt::format("'{}' cannot be used", key), fmt::format("{:g}", found), allowed);
}

}  // namespace

void validate(const Material& m, const char* where)
{
  constexpr double huge = std::numeric_limits<double>::max();
  require(m.density > 0 && m.density <= huge, where, "density", m.density, "over 0 (kg/m^3)");
  require(m.youngs_modulus > 0 && m.youngs_modulus <= huge, where, "youngs_modulus", m.youngs_modulus,
          "over 0 (Pa)");
  require(m.poisson_ratio >= 0 && m.poisson_ratio < 0.4999, where, "poisson_ratio", m.poisson_ratio,
          "0 up to, not including, 0.4999 (0.5 is incompressible: E* would need infinite bulk stiffness)");
  require(m.yield_stress > 0, where, "yield_stress", m.yield_stress,
          "over 0 (Pa), or absent for an elastic body");
  require(!m.yields() || m.e_star() / m.yield_stress >= 10.0, where, "yield_stress", m.yield_stress,
          "at most a tenth of E* = E/(1-nu^2)");
  require(m.hardening_modulus >= 0 && m.hardening_modulus <= m.youngs_modulus, where, "hardening.modulus",
          m.hardening_modulus, "0 up to youngs_modulus (Pa)");
  validate_flow(m, where);
}

}  // namespace granulaw
