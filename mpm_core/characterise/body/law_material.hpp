#pragma once

#include <cmath>
#include <string>

#include "atlas/stand_in.hpp"
#include "law/law.hpp"
#include "solver/material/law_table.hpp"
#include "solver/material/material.hpp"

namespace granulaw {

/// The five numbers of a material that a law file keeps, and its name there.
inline LawMaterial law_material(const std::string& name, const Material& m)
{
  return {name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
}

/// The solver's material of these five numbers: linear or no hardening, no rate dependence.
inline Material material_of(const LawMaterial& m)
{
  return {m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
}

/// sqrt(Y/rho), m/s: the speed on a rigid wall at which rho V^2/Y (Johnson's damage number) is 1. The speed
/// coordinate of a law is a speed over this one.
inline double speed_unit(const LawMaterial& m)
{
  return std::sqrt(m.yield_stress / m.density);
}

/// Flow stress over the yield stress, of the solver's material.
inline FlowCurve flow_curve(const Material& material)
{
  return [material](double strain) { return flow_stress(material, strain) / material.yield_stress; };
}

}  // namespace granulaw
