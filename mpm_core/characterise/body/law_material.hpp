#pragma once

#include <cmath>
#include <string>

#include "atlas/stand_in.hpp"
#include "law/law.hpp"
#include "solver/material/law_table.hpp"
#include "solver/material/material.hpp"

namespace granulaw {

/// The part of a material that a law file keeps: its name there, five numbers, and the flow stress of hardening
/// that is not linear.
inline LawMaterial law_material(const std::string& name, const Material& m)
{
  LawMaterial kept{name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus};
  if (m.hardening.name.empty()) return kept;
  // four nodes a doubling: straight between them, laws of usual shape are within 0.2 %
  constexpr double first = 1e-4, last = 4.0, ratio = 1.189207115002721;
  for (double strain = 0; strain < last; strain = std::max(first, strain * ratio)) {
    kept.flow.strain.push_back(strain);
    kept.flow.stress.push_back(flow_stress(m, strain));
  }
  return kept;
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
