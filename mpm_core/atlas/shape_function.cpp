#include "atlas/shape_function.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

namespace granulaw {

ShapeFunction::ShapeFunction(std::vector<double> values, double q_end, Kind kind)
    : values_(kind == Kind::rising ? raised(std::move(values)) : std::move(values)),
      spacing_(q_end / static_cast<double>(values_.size() - 1)),
      q_end_(q_end)
{
  const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(
      values_.begin(), values_.end(), 0.0, spacing_, 0.0, end_slope());
  for (std::size_t k = 0; k < values_.size(); ++k)
    slopes_.push_back(k ? spline.prime(spacing_ * static_cast<double>(k)) : 0.0);
  if (kind == Kind::rising) limit_slopes();
}

/// Of the cubic through the last four nodes. Where none is given, Boost 1.74 takes the slope at the fifth last
/// node.
double ShapeFunction::end_slope() const
{
  const auto last = values_.rbegin();
  return (11 * last[0] - 18 * last[1] + 9 * last[2] - 2 * last[3]) / (6 * spacing_);
}

double ShapeFunction::value(double q) const
{
  if (q > q_end_) return values_.back() + (q - q_end_) * slopes_.back();
  return q > 0 ? at(q, false) : 0.0;
}

double ShapeFunction::slope(double q) const
{
  return q > 0 ? at(std::min(q, q_end_), true) : 0.0;
}

std::vector<double> ShapeFunction::raised(std::vector<double> values)
{
  double most = 0;
  for (double& v : values) v = most = std::max(most, v);
  return values;
}

/// A cubic between two nodes rises if neither slope is negative or over three times the chord's (Fritsch
/// and Carlson 1980, the sufficient square); slopes within that are left as they are.
void ShapeFunction::limit_slopes()
{
  for (double& slope : slopes_) slope = std::max(0.0, slope);
  for (std::size_t k = 0; k + 1 < values_.size(); ++k) {
    const double most = 3 * (values_[k + 1] - values_[k]) / spacing_;
    slopes_[k] = std::min(slopes_[k], most);
    slopes_[k + 1] = std::min(slopes_[k + 1], most);
  }
}

double ShapeFunction::at(double q, bool slope) const
{
  const auto k = std::min(static_cast<std::size_t>(q / spacing_), values_.size() - 2);
  const double t = q / spacing_ - static_cast<double>(k), chord = values_[k + 1] - values_[k];
  const double first = spacing_ * slopes_[k], second = first + spacing_ * slopes_[k + 1] - 2 * chord;
  const double c2 = chord - first - second, c3 = second;
  if (slope) return (first + t * (2 * c2 + 3 * t * c3)) / spacing_;
  return values_[k] + t * (first + t * (c2 + t * c3));
}

}  // namespace granulaw
