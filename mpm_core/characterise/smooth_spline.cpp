#include "characterise/smooth_spline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// The four uniform cubic B-splines that are non-zero at t in [0,1] of an interval, and their d/dt.
struct Basis
{
  double value[4], slope[4];
  explicit Basis(double t)
  {
    const double r = 1 - t;
    value[0] = r * r * r / 6;
    value[1] = (3 * t * t * t - 6 * t * t + 4) / 6;
    value[2] = (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6;
    value[3] = t * t * t / 6;
    slope[0] = -r * r / 2;
    slope[1] = (3 * t * t - 4 * t) / 2;
    slope[2] = (-3 * t * t + 2 * t + 1) / 2;
    slope[3] = t * t / 2;
  }
};

}  // namespace

SmoothSpline::SmoothSpline(double q_end, int intervals, std::span<const Sample> samples, double stiffness)
    : spacing_(q_end / intervals)
{
  if (samples.size() < 2) fail("fit", "too few samples", std::to_string(samples.size()), "2 or more");
  // Coefficients c_0..c_{intervals+2}. y(0) = (c_0 + 4 c_1 + c_2)/6 = 0 and y'(0) = (c_2 - c_0)/2h = 0
  // make c_0 = c_2 = -2 c_1: the unknowns are c_2, c_3, ..., with c_1 = -c_2/2, c_0 = c_2.
  const int all = intervals + 3, unknowns = all - 2;
  const auto rows = static_cast<Eigen::Index>(samples.size()) + all - 3;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, unknowns);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
  const auto add = [&](Eigen::Index row, int coefficient, double factor) {
    if (coefficient == 0)
      a(row, 0) += factor;
    else if (coefficient == 1)
      a(row, 0) -= 0.5 * factor;
    else
      a(row, coefficient - 2) += factor;
  };
  double mean_square = 0;
  Eigen::Index row = 0;
  for (const Sample& s : samples) {
    const int k = std::clamp(static_cast<int>(s.q / spacing_), 0, intervals - 1);
    const Basis basis(s.q / spacing_ - k);
    for (int j = 0; j < 4; ++j) add(row, k + j, s.weight * basis.value[j]);
    b(row++) = s.weight * s.value;
    mean_square += s.weight * s.weight;
  }
  const double penalty = stiffness * std::sqrt(mean_square / intervals);
  for (int k = 0; k + 3 < all; ++k, ++row) {
    constexpr double third_difference[4] = {-1, 3, -3, 1};
    for (int j = 0; j < 4; ++j) add(row, k + j, penalty * third_difference[j]);
  }
  const Eigen::VectorXd c = a.colPivHouseholderQr().solve(b);
  coefficients_ = {c(0), -0.5 * c(0)};
  coefficients_.insert(coefficients_.end(), c.data(), c.data() + c.size());
}

SmoothSpline::Point SmoothSpline::evaluate(double q) const
{
  if (q <= 0 || coefficients_.empty()) return {0, 0};
  const int intervals = static_cast<int>(coefficients_.size()) - 3;
  const int k = std::clamp(static_cast<int>(q / spacing_), 0, intervals - 1);
  const Basis basis(q / spacing_ - k);
  Point point{0, 0};
  for (int j = 0; j < 4; ++j) {
    point.value += coefficients_[static_cast<std::size_t>(k + j)] * basis.value[j];
    point.slope += coefficients_[static_cast<std::size_t>(k + j)] * basis.slope[j] / spacing_;
  }
  return point;
}

}  // namespace granulaw
