#pragma once

#include <algorithm>
#include <array>
#include <limits>

namespace granulaw {

/// A box with edges along the axes; as made it is empty. Sides may be infinite.
struct Box
{
  using Point = std::array<double, 3>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  bool empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  Point size() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }

  void include(const Point& p)
  {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }

  void include(const Box& other)
  {
    if (other.empty()) return;
    include(other.low);
    include(other.high);
  }

  /// The part of this in `other`.
  Box within(const Box& other) const
  {
    Box part = *this;
    for (std::size_t k = 0; k < 3; ++k) {
      part.low[k] = std::max(low[k], other.low[k]);
      part.high[k] = std::min(high[k], other.high[k]);
    }
    return part;
  }

  /// With its sides this much further in; a side that would pass its opposite stays in the middle.
  Box shrunk(double by) const
  {
    Box part = *this;
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = std::min(by, 0.5 * (high[k] - low[k]));
      part.low[k] += step, part.high[k] -= step;
    }
    return part;
  }

  /// Largest and smallest coordinate along the unit vector `axis`.
  double top(const Point& axis) const
  {
    double sum = 0;  // side by side: 0 times an infinite side is 0
    for (std::size_t k = 0; k < 3; ++k)
      if (axis[k] != 0) sum += axis[k] * (axis[k] > 0 ? high[k] : low[k]);
    return sum;
  }
  double bottom(const Point& axis) const { return -top({-axis[0], -axis[1], -axis[2]}); }
};

}  // namespace granulaw
