#pragma once

#include <cmath>

namespace granulaw::deck {

/// The number of `digits` significant digits that is next to x by `to_whole`, std::floor or std::ceil; within 1e-12 of one it is that.
inline double with_digits(double x, int digits, double (*to_whole)(double), double rounding)
{
  const double last = std::floor(std::log10(x)) + 1 - digits, unit = std::pow(10.0, std::abs(last));  // the double next to the decimal number
  return last < 0 ? to_whole(x * unit * rounding) / unit : to_whole(x / unit * rounding) * unit;
}
inline double rounded_down(double x, int digits = 2) { return with_digits(x, digits, std::floor, 1 + 1e-12); }
inline double rounded_up(double x, int digits = 2) { return with_digits(x, digits, std::ceil, 1 - 1e-12); }

}  // namespace granulaw::deck
