#pragma once

#include <cstddef>
#include <vector>

namespace granulaw {

/// Slopes of cubics through values at nodes `h` apart.

/// Three-point differences; through two values the chord, of one 0.
std::vector<double> difference_slopes(const std::vector<double>& values, double h);
/// The same on either side of a node where the function has a kink, with the slope beyond it at the node.
std::vector<double> difference_slopes_in_parts(const std::vector<double>& values, std::size_t kink, double h);

/// The value's slope, as far as cubics between such nodes stay above 0: up to 3/h of the value, since the
/// Bernstein coefficients next to a node are value +- h slope/3.
double slope_of_a_positive(double slope, double value, double h);

/// A function that leaves 0 with no slope and does not fall: values below an earlier one are raised to it,
/// difference slopes limited to 3 times the chords beside (Fritsch and Carlson, SIAM J. Numer. Anal. 17,
/// 1980).
struct Rising
{
  std::vector<double> value, slope;
  Rising(std::vector<double> values, double h);
};

}  // namespace granulaw
