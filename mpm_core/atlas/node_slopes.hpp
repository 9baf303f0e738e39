#pragma once

#include <cstddef>
#include <vector>

namespace granulaw {

/// Slopes of cubics through values at nodes `h` apart.

/// Three-point differences; through two values the chord, of one 0.
std::vector<double> difference_slopes(const std::vector<double>& values, double h);

}  // namespace granulaw
