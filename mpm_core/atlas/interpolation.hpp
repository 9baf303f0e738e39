#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace granulaw {

/// Natural logarithms: nodes of a coordinate that counts in factors.
inline std::vector<double> logarithms(const std::vector<double>& values)
{
  std::vector<double> logs;
  for (const double value : values) logs.push_back(std::log(value));
  return logs;
}

/// Weights of Lagrange's polynomial through the (up to) four of the ascending `nodes` nearest to x; zero for
/// the others. Beyond the ends: the end value.
inline std::vector<double> interpolation_weights(const std::vector<double>& nodes, double x)
{
  std::vector<double> weights(nodes.size(), 0.0);
  x = std::clamp(x, nodes.front(), nodes.back());
  const auto count = std::min<std::size_t>(4, nodes.size());
  const auto above =
      static_cast<std::size_t>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
  const std::size_t first = std::min(above >= 2 ? above - 2 : 0, nodes.size() - count);
  for (std::size_t i = first; i < first + count; ++i) {
    weights[i] = 1;
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) weights[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
  }
  return weights;
}

}  // namespace granulaw
