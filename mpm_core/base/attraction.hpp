#pragma once

#include <algorithm>

namespace granulaw {

/// Attraction of short range between two surfaces: it falls linearly from 2 work/range where they touch to nothing at a gap of `range`.
struct Attraction
{
  double work = 0;   ///< J/m2, work of adhesion of the pair; 0: none
  double range = 0;  ///< m

  /// Pa, of surfaces a `gap` apart; those that touch are pulled most.
  double traction(double gap) const { return gap < range ? 2 * work / range * (1 - std::max(gap, 0.0) / range) : 0.0; }
};

}  // namespace granulaw
