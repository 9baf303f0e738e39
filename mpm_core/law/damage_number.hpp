#pragma once

#include <cmath>

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

/// 1/s, the plastic strain rate in a dent, to a factor of two: a strain of 0.1 a/R (docs/evidence/leeb.md) in the time of
/// loading, 0.4 a^2/(R V), is V/(4 a); a^2 = 2 R* overlap.
inline double dent_rate(double speed, double r_eff, double overlap)
{
  return 0.25 * speed / std::sqrt(2 * r_eff * overlap);
}

}  // namespace granulaw
