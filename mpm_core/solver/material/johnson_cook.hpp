#pragma once

#include "solver/material/vector_math.hpp"

namespace granulaw::flow {

/// Johnson and Cook (1983), static part: sigma_y = Y + strength ep^exponent.
struct JohnsonCook
{
  static constexpr const char* name = "johnson-cook";
  static constexpr Parameter parameters[] = {
      {"strength", Quantity::stress, 0, no_limit, false, {.per_gain = 2}},
      {"exponent", Quantity::number, 0.05, 1, false, {.number = 0.25}}};

  double yield, strength, exponent;

  static void scale_strains(double* v, double by) { v[0] *= power(by, -v[1]); }
  static GRANULAW_MEMBER JohnsonCook from(double yield_stress, const double* v)
  {
    return {yield_stress, v[0], v[1]};
  }
  GRANULAW_MEMBER ValueAndSlope operator()(double ep) const
  {
    const double strain = ep + 1e-300;  // the slope at 0 is infinite
    const double gain = strength * power(strain, exponent);
    return {yield + gain, exponent * gain / strain};
  }
  GRANULAW_MEMBER double strain_at(double stress) const
  {
    return power((stress - yield) / strength, 1.0 / exponent);
  }
};

/// Johnson and Cook (1983), rate factor: 1 + coefficient ln(rate/reference_rate), 1 below the reference rate.
struct JohnsonCookRate
{
  static constexpr const char* name = "johnson-cook";
  static constexpr Parameter parameters[] = {{"coefficient", Quantity::number, 0, 10},
                                             {"reference_rate", Quantity::rate, over_zero, no_limit}};

  double coefficient, per_reference;

  static GRANULAW_MEMBER JohnsonCookRate from(const double* v) { return {v[0], 1.0 / v[1]}; }
  GRANULAW_MEMBER ValueAndSlope operator()(double rate) const
  {
    const double ratio = rate * per_reference;
    const double above = ratio > 1.0 ? ratio : 1.0;
    return {1.0 + coefficient * log(above), ratio > 1.0 ? coefficient / rate : 0.0};
  }
  GRANULAW_MEMBER double rate_at(double excess) const { return exp(excess / coefficient) / per_reference; }
};

}  // namespace granulaw::flow
