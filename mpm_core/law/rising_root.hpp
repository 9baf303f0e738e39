#pragma once

#include <boost/math/tools/toms748_solve.hpp>

namespace granulaw {

/// y(x) = 0 of a rising y between two ends, to a relative accuracy of 2^-bits; the end where it does not
/// cross 0.
template <class F>
double rising_root(const F& y, double low, double high, int bits)
{
  const double at_low = y(low), at_high = y(high);
  if (at_low >= 0) return low;
  if (at_high <= 0) return high;
  std::uintmax_t steps = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      y, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(bits), steps);
  return 0.5 * (a + b);
}

}  // namespace granulaw
