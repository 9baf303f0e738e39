#pragma once

#include "solver/material/vector_math.hpp"

namespace granulaw::flow {

/// Cowper and Symonds (1957), rate factor: 1 + (rate/reference_rate)^(1/exponent).
struct CowperSymonds
{
  static constexpr const char* name = "cowper-symonds";
  static constexpr Parameter parameters[] = {{"reference_rate", Quantity::rate, over_zero, no_limit},
                                             {"exponent", Quantity::number, 1, 20}};

  double per_reference, power_of_rate;

  static GRANULAW_MEMBER CowperSymonds from(const double* v) { return {1.0 / v[0], 1.0 / v[1]}; }
  GRANULAW_MEMBER ValueAndSlope operator()(double rate) const
  {
    const double some = rate + 1e-300;  // the slope at 0 is infinite
    const double gain = power(some * per_reference, power_of_rate);
    return {1.0 + gain, power_of_rate * gain / some};
  }
  GRANULAW_MEMBER double rate_at(double excess) const
  {
    return power(excess, 1.0 / power_of_rate) / per_reference;
  }
};

}  // namespace granulaw::flow
