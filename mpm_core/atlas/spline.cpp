#include "atlas/spline.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <boost/math/special_functions/cardinal_b_spline.hpp>

#include "base/error.hpp"
#include "linear/linear.hpp"

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

Spline Spline::fit(std::span<const Sample> samples, double end, int intervals, double stiffness, int order)
{
  if (samples.size() < 2) fail("fit", "too few samples", std::to_string(samples.size()), "2 or more");
  // Coefficients c_0 ... c_{intervals+2}: y(0) = (c_0 + 4 c_1 + c_2)/6 = 0 and y'(0) = (c_2 - c_0)/2h = 0 make
  // c_0 = c_2 = -2 c_1. So the unknowns are c_2, c_3, ...
  const double spacing = end / intervals;
  const int all = intervals + 3, unknowns = all - 2;
  const auto rows = static_cast<Eigen::Index>(samples.size()) + all - order;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, unknowns);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
  const auto add = [&](Eigen::Index row, int coefficient, double factor) {
    a(row, std::max(0, coefficient - 2)) += coefficient == 1 ? -0.5 * factor : factor;
  };
  double mean_square = 0;
  Eigen::Index row = 0;
  for (const Sample& s : samples) {
    const double place = std::min(s.q, end) / spacing, beyond = std::max(0.0, s.q - end) / spacing;
    const int k = std::clamp(static_cast<int>(place), 0, intervals - 1);
    for (int j = 0; j < 4; ++j) {
      const double at = place - (k + j - 1);  // c_{k+j} belongs to node k + j - 1
      add(row, k + j,
          s.weight * (boost::math::cardinal_b_spline<3>(at) +
                      beyond * boost::math::cardinal_b_spline_prime<3>(at)));
    }
    b(row++) = s.weight * s.value;
    mean_square += s.weight * s.weight;
  }
  const double penalty = stiffness * std::sqrt(mean_square / intervals);
  for (int k = 0; k + order < all; ++k, ++row) {
    double binomial = order % 2 ? -1 : 1;
    for (int j = 0; j <= order; ++j) {
      add(row, k + j, penalty * binomial);
      binomial *= -static_cast<double>(order - j) / (j + 1);
    }
  }
  const Eigen::VectorXd solved = least_squares(a, b);
  std::vector<double> c{solved(0), -0.5 * solved(0)};
  c.insert(c.end(), solved.data(), solved.data() + solved.size());
  HermiteColumn nodes;
  for (std::size_t k = 0; k + 2 < c.size(); ++k)
    nodes.add((c[k] + 4 * c[k + 1] + c[k + 2]) / 6, (c[k + 2] - c[k]) / (2 * spacing));
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
