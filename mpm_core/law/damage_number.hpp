#pragma once

#include "law/law.hpp"

namespace granulaw {

/// Damage number I = rho V^2/Y of a pair at the relative normal speed `speed`, m/s: density and yield stress
/// are those of the yielding body, V = speed/sqrt(lambda) is its share of the approach (all on a rigid wall,
/// half between like bodies). On a rigid wall and between like spheres it is v^2 of the velocity axis
/// (AxisTable). Certificate::damage_number_max is the largest one for which the errors of a law were
/// shown to hold.
inline double damage_number(const LawMaterial& yielding, const PairMapping& mapping, double speed)
{
  const double share = speed / mapping.sqrt_lambda;
  return yielding.density * share * share / yielding.yield_stress;
}

/// Of a resolved pair. 0: the bodies are elastic.
inline double damage_number(const PairLaw& pair, double speed)
{
  const LawMaterial& yielding = pair.yielding->material;
  return yielding.yields() ? damage_number(yielding, pair.mapping, speed) : 0.0;
}

}  // namespace granulaw
