#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace granulaw {

/// Bound that 95 % of all errors lie within, with a confidence of 95 %, from those of some: the k-th smallest
/// of n is too low only if at least k of n lay within, a binomial of n and 0.95 (Wilks 1941): the largest of
/// 59 to 92, the 99th of 100, the 196th of 200; of fewer than 59 not even the largest is enough. At least
/// half the largest, since none may exceed twice the bound. 0 of none.
inline double confident_bound(std::vector<double> values)
{
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double k = n, exactly = std::pow(0.95, n), at_least = exactly;
  while (k > 1) {
    exactly *= k / (n - k + 1) * 0.05 / 0.95;  // from k of n to k - 1
    if (at_least + exactly > 0.05) break;
    at_least += exactly;
    --k;
  }
  return std::max(values[static_cast<std::size_t>(k) - 1], 0.5 * values.back());
}

/// The same of the magnitudes of one error of checks.
template <class Check>
double confident_bound(const std::vector<Check>& checks, double Check::*error)
{
  std::vector<double> values;
  for (const Check& c : checks) values.push_back(std::abs(c.*error));
  return confident_bound(std::move(values));
}

}  // namespace granulaw
