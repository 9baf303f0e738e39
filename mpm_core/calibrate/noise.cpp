#include "calibrate/noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// What a force is off the cubic through its neighbours, over what unit scatter of all five would make of it.
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

double largest_force(const Measurement& m)
{
  double most = 0;
  for (const Datum& d : m.data) most = std::max(most, d.y);
  return most;
}

}  // namespace

double ForceScatter::at(double force) const
{
  return std::hypot(constant, share * force);
}

ForceScatter scatter_of(const Measurement& curve)
{
  constexpr double least = 1e-4, most = 0.3;  // of the largest force, and of the share
  constexpr int steps = 32;
  const std::vector<PseudoResidual> residuals = pseudo_residuals(curve);
  const double unit = largest_force(curve);
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

namespace {

void fill_in_standard_deviations(Measurement& m, double relative_sd)
{
  if (std::all_of(m.data.begin(), m.data.end(), [](const Datum& d) { return d.sd > 0; })) return;
  if (is_curve(m.kind)) {
    const ForceScatter scatter = scatter_of(m);
    const double floor = 1e-3 * largest_force(m);
    for (Datum& d : m.data) d.sd = std::max(floor, scatter.at(d.y));
    return;
  }
  for (Datum& d : m.data)
    if (d.sd == 0) d.sd = relative_sd * d.y, d.relative_sd = relative_sd;
}

/// Noise may lift an e near 1 over it: one value in thirty thousand by more than four standard deviations.
void check_restitution(const Measurement& m)
{
  constexpr double beyond_noise = 4;
  for (const Datum& d : m.data)
    if (d.y > 1 + beyond_noise * d.sd)
      fail(fmt::format("{}:{}", m.source, d.line), "'restitution' is over 1 by more than its noise",
           fmt::format("{:g}, standard deviation {:.2g}", d.y, d.sd),
           fmt::format("over 0, up to 1 and {:g} standard deviations", beyond_noise));
}

}  // namespace

void complete_standard_deviations(Measurement& m, double relative_sd)
{
  fill_in_standard_deviations(m, relative_sd);
  if (m.kind == MeasurementKind::restitution) check_restitution(m);
}

}  // namespace granulaw
