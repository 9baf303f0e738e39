#pragma once

#include "solver/material/vector_math.hpp"

namespace granulaw::flow {

/// Swift (1952): sigma_y = strength (offset + ep)^exponent. strength offset^exponent is the yield stress.
struct Swift
{
  static constexpr const char* name = "swift";
  static constexpr Parameter parameters[] = {
      {"strength", Quantity::stress, over_zero, no_limit},
      {"exponent", Quantity::number, 0.05, 1, false, {.number = 0.25}},
      {"offset", Quantity::number, 1e-12, 10, false, {.per_strain = 1}}};

  double strength, exponent, offset;

  static void scale_strains(double* v, double by) { v[0] *= power(by, -v[1]), v[2] *= by; }
  static GRANULAW_MEMBER Swift from(double /*yield_stress*/, const double* v) { return {v[0], v[1], v[2]}; }
  GRANULAW_MEMBER ValueAndSlope operator()(double ep) const
  {
    const double stress = strength * power(offset + ep, exponent);
    return {stress, exponent * stress / (offset + ep)};
  }
  GRANULAW_MEMBER double strain_at(double stress) const
  {
    return power(stress / strength, 1.0 / exponent) - offset;
  }
};

}  // namespace granulaw::flow
