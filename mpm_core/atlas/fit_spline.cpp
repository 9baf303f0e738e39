#include "atlas/fit_spline.hpp"

#include <algorithm>
#include <boost/math/special_functions/cardinal_b_spline.hpp>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "linear/linear.hpp"

namespace granulaw {

Spline fit_spline(std::span<const SplineSample> samples, double end, int intervals, double stiffness,
                  int order)
{
  if (samples.size() < 2) fail("fit", "too few samples", std::to_string(samples.size()), "2 or more");
  // Coefficients c_0 ... c_{intervals+2}: y(0) = (c_0 + 4 c_1 + c_2)/6 = 0 and y'(0) = (c_2 - c_0)/2h = 0
  // make c_0 = c_2 = -2 c_1. So the unknowns are c_2, c_3, ...
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
  for (const SplineSample& s : samples) {
    const double place = std::min(s.q, end) / spacing, beyond = std::max(0.0, s.q - end) / spacing;
    const int k = std::clamp(static_cast<int>(place), 0, intervals - 1);
    for (int j = 0; j < 4; ++j) {
      const double at = place - (k + j - 1);  // c_{k+j} belongs to node k + j - 1
      add(row, k + j,
          s.weight *
              (boost::math::cardinal_b_spline<3>(at) + beyond * boost::math::cardinal_b_spline_prime<3>(at)));
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

}  // namespace granulaw
