#include "calibrate/noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

/// Residual of a force from the cubic through its four neighbours, over the residual for unit scatter of all
/// five.
struct PseudoResidual
{
  double force, residual;
};

std::vector<PseudoResidual> pseudo_residuals(const Measurement& m)
{
  constexpr double most_gain = 20;  // of the scatter: neighbours too unevenly spaced
  const std::size_t loading = m.loading_rows();
  std::vector<PseudoResidual> found;
  for (std::size_t k = 2; k + 2 < m.data.size(); ++k) {
    if ((k - 2 < loading) != (k + 2 < loading)) continue;  // on one branch
    const std::size_t neighbours[] = {k - 2, k - 1, k + 1, k + 2};
    double cubic = 0, gain = 1;
    for (const std::size_t i : neighbours) {
      double weight = 1;
      for (const std::size_t j : neighbours)
        if (j != i) weight *= (m.data[k].x - m.data[j].x) / (m.data[i].x - m.data[j].x);
      cubic += weight * m.data[i].y, gain += weight * weight;
    }
    if (!(gain < most_gain)) continue;
    found.push_back({std::abs(cubic), (m.data[k].y - cubic) / std::sqrt(gain)});
  }
  return found;
}

}  // namespace

double ForceScatter::at(double force) const
{
  return std::hypot(constant, share * force);
}

ForceScatter scatter_of(const Measurement& curve)
{
  constexpr double least = 1e-4, most = 0.3;  // of the largest force, and of the fraction
  constexpr int steps = 32;
  const std::vector<PseudoResidual> residuals = pseudo_residuals(curve);
  const double unit = curve.largest_y();
  ForceScatter best{0.01 * unit, 0};
  double best_cost = std::numeric_limits<double>::infinity();
  if (residuals.size() < 3) return best;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const ForceScatter s{unit * least * std::pow(most / least, static_cast<double>(i) / steps),
                           least * std::pow(most / least, static_cast<double>(j) / steps)};
      double cost = 0;
      for (const PseudoResidual& r : residuals) {
        const double sd = s.at(r.force);
        cost += 2 * std::log(sd) + r.residual * r.residual / (sd * sd);
      }
      if (cost < best_cost) best_cost = cost, best = s;
    }
  return best;
}

void complete_standard_deviations(Measurement& m, double relative_sd)
{
  m.kind->complete(m, relative_sd);
  constexpr double beyond_noise = 4;  // sd: one value in thirty thousand
  const Column& y = m.kind->y;
  for (const Datum& d : m.data)
    if (d.y > y.most + beyond_noise * d.sd)
      fail(fmt::format("{}:{}", m.source, d.line),
           fmt::format("'{}' is over {:g} by more than its noise", y.name(), y.most),
           fmt::format("{:g}, standard deviation {:.2g}", d.y, d.sd),
           fmt::format("{}, up to {:g} and {:g} standard deviations", y.allowed, y.most, beyond_noise));
}

}  // namespace granulaw
