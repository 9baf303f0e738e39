#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "atlas/interpolation.hpp"
#include "contact/axis.hpp"

namespace granulaw {

/// Between the speeds v = sqrt(rho V^2/Y) of impacts, for what speed changes. Inertia: cubics in v through
/// the standstill, where it changes nothing; it is even in v, so the slowest impact stands at -v, too. A
/// rate: cubics in ln v, and below its slowest impact as there.
class SpeedInterpolation
{
 public:
  /// `speeds`: ascending.
  SpeedInterpolation(std::span<const double> speeds, AxisTable::By kind)
      : rate_(kind == AxisTable::By::rate)
  {
    if (!rate_ && !speeds.empty()) nodes_.push_back(-speeds.front());
    if (!rate_) nodes_.push_back(0.0);
    first_ = nodes_.size();
    for (const double v : speeds) nodes_.push_back(coordinate(v));
  }

  /// In which the interpolation is cubic.
  double coordinate(double v) const { return rate_ ? std::log(v) : v; }

  /// A quantity at speed v; `of(j)`: at the j-th of the speeds.
  template <class Of>
  double at(double v, const Of& of) const
  {
    const std::vector<double> weights = interpolation_weights(nodes_, coordinate(v));
    double sum = 0;
    if (first_ == 2 && weights[0] != 0) sum += weights[0] * of(0);
    for (std::size_t j = first_; j < weights.size(); ++j)
      if (weights[j] != 0) sum += weights[j] * of(j - first_);
    return sum;
  }

 private:
  bool rate_;
  std::size_t first_;          // node of the slowest impact; before it -v and the standstill
  std::vector<double> nodes_;  // coordinates
};

}  // namespace granulaw
