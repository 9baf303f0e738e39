#include "law/spline.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

namespace granulaw {

namespace {

/// Slope at the end of the cubic through the last four values. Where none is given, Boost 1.74 takes the slope
/// at the fifth last node.
double end_slope(const std::vector<double>& values, double spacing)
{
  const auto last = values.rbegin();
  return (11 * last[0] - 18 * last[1] + 9 * last[2] - 2 * last[3]) / (6 * spacing);
}

}  // namespace

Spline Spline::through(std::vector<double> values, double end)
{
  const double spacing = end / static_cast<double>(values.size() - 1);
  const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(
      values.begin(), values.end(), 0.0, spacing, 0.0, end_slope(values, spacing));
  HermiteColumn nodes;
  for (std::size_t k = 0; k < values.size(); ++k)
    nodes.add(values[k], k ? spline.prime(spacing * static_cast<double>(k)) : 0.0);
  return {std::move(nodes), end};
}

Spline::Place Spline::place(double q) const
{
  const double h = spacing();
  const auto k = std::min(static_cast<std::size_t>(q / h), nodes_.size() - 2);
  Place at;
  at.t = q / h - static_cast<double>(k);
  hermite(at.c, nodes_.value[k], nodes_.value[k + 1], h * nodes_.slope[k], h * nodes_.slope[k + 1]);
  return at;
}

double Spline::value(double q) const
{
  if (q > end_) return nodes_.value.back() + (q - end_) * nodes_.slope.back();
  if (!(q > 0)) return 0;
  const Place at = place(q);
  return cubic(at.c, at.t);
}

double Spline::slope(double q) const
{
  if (!(q > 0)) return 0;
  const Place at = place(std::min(q, end_));
  return cubic_slope(at.c, at.t) / spacing();
}

std::vector<double> Spline::values(std::size_t places) const
{
  std::vector<double> all;
  for (std::size_t k = 0; k < places; ++k)
    all.push_back(value(end_ * static_cast<double>(k) / static_cast<double>(places - 1)));
  return all;
}

}  // namespace granulaw
