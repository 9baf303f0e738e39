#pragma once

#include "solver/material/parameter.hpp"

namespace granulaw::flow {

/// Rate factor of a material that does not depend on the rate: what one has that names no rate law. It has no
/// keys; the one here stands for none.
struct RateIndependent
{
  static constexpr const char* name = "none";
  static constexpr Parameter parameters[] = {{"", Quantity::number, 0, 0}};
  static GRANULAW_MEMBER RateIndependent from(const double*) { return {}; }
  GRANULAW_MEMBER ValueAndSlope operator()(double) const { return {1.0, 0.0}; }
  GRANULAW_MEMBER double rate_at(double) const { return unreached; }
};

}  // namespace granulaw::flow
