#pragma once

#include <cmath>

namespace granulaw {

/// The larger of two; a value that is no number stays, unlike in std::max, where the order decides.
inline double larger(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

}  // namespace granulaw
