#pragma once

#include "solver/material/vector_math.hpp"

namespace granulaw::flow {

/// Voce (1948): sigma_y = S - (S - Y) exp(-ep/strain), S the saturation stress.
struct Voce
{
  static constexpr const char* name = "voce";
  static constexpr Parameter parameters[] = {
      {"saturation_stress", Quantity::stress, over_zero, no_limit, false, {.per_yield = 1, .per_gain = 1}, 1},
      {"strain", Quantity::number, 1e-6, 100, false, {.per_strain = 1}}};

  double yield, saturation, per_strain;

  static const char* misuse(double yield_stress, const double* v)
  {
    return v[0] < parameters[0].least_per_yield * yield_stress
               ? "'saturation_stress' is below yield_stress; strain softening is not supported"
               : nullptr;
  }
  static void scale_strains(double* v, double by) { v[1] *= by; }
  static GRANULAW_MEMBER Voce from(double yield_stress, const double* v)
  {
    return {yield_stress, v[0], 1.0 / v[1]};
  }
  GRANULAW_MEMBER ValueAndSlope operator()(double ep) const
  {
    const double missing = (saturation - yield) * exp(-ep * per_strain);
    return {saturation - missing, missing * per_strain};
  }
  GRANULAW_MEMBER double strain_at(double stress) const
  {
    const double missing = (saturation - stress) / (saturation - yield);
    return missing > 0.0 ? -log(missing) / per_strain : unreached;
  }
};

}  // namespace granulaw::flow
