#pragma once

#include "solver/material/parameter.hpp"

namespace granulaw::flow {

/// sigma_y = Y + modulus ep; modulus 0: perfectly plastic. Without rate dependence the kernel has its return
/// in closed form.
struct Linear
{
  static constexpr const char* name = "linear";
  static constexpr Parameter parameters[] = {{"modulus",
                                              Quantity::stress,
                                              0,
                                              no_limit,
                                              false,
                                              {.per_yield = 0.3243606353500641}}};  // ln(1 + 2 H/Y) = .5

  double yield, modulus;

  static GRANULAW_MEMBER Linear from(double yield_stress, const double* v) { return {yield_stress, v[0]}; }
  static void scale_strains(double* v, double by) { v[0] /= by; }
  GRANULAW_MEMBER ValueAndSlope operator()(double ep) const { return {yield + modulus * ep, modulus}; }
  GRANULAW_MEMBER double strain_at(double) const { return unreached; }
};

}  // namespace granulaw::flow
