#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace granulaw {

/// Half-way between the neighbours of ascending shares.
inline std::vector<double> half_ways(std::span<const double> shares)
{
  std::vector<double> bounds;
  for (std::size_t k = 1; k < shares.size(); ++k) bounds.push_back(0.5 * (shares[k - 1] + shares[k]));
  return bounds;
}

/// Index of the size ratio nearest to own/sum, by half_ways() of all ratios; half-way itself goes to the
/// lower one. No division: contact loops call it.
inline std::size_t nearest_share(const std::vector<double>& bounds, double own, double sum)
{
  std::size_t k = 0;
  for (const double bound : bounds) k += static_cast<std::size_t>(own > bound * sum);
  return k;
}

}  // namespace granulaw
