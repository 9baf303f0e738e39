#pragma once

#include "law/law.hpp"

namespace granulaw {

/// Damage number I = rho V^2/Y of a pair at the relative normal speed `speed`, m/s (ImpactMeasure). On a
/// rigid wall and between like spheres it is v^2 of the velocity axis (AxisTable).
/// Certificate::damage_number_max is the largest one for which the errors of a law were shown to hold.
inline double damage_number(const LawMaterial& yielding, const PairMapping& mapping, double speed)
{
  return ImpactMeasure{yielding.density, yielding.yield_stress}.damage_number(mapping, speed);
}

/// Damage number of a resolved pair. 0: the bodies are elastic.
inline double damage_number(const PairLaw& pair, double speed)
{
  return pair.measure().damage_number(pair.mapping, speed);
}

}  // namespace granulaw
