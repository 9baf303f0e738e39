#include "calibrate/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
  const std::size_t reversal = m.reversal();
  std::vector<PseudoResidual> found;
  for (std::size_t k = 2; k + 2 < m.data.size(); ++k) {
    if ((k - 2 < reversal) != (k + 2 <= reversal)) continue;  // on one branch
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

void complete_standard_deviations(Measurement& m, double relative_sd)
{
  if (std::all_of(m.data.begin(), m.data.end(), [](const Datum& d) { return d.sd > 0; })) return;
  if (is_curve(m.kind)) {
    const ForceScatter scatter = scatter_of(m);
    const double floor = 1e-3 * largest_force(m);
    for (Datum& d : m.data) d.sd = std::max(floor, scatter.at(d.y));
    return;
  }
  for (Datum& d : m.data)
    if (d.sd == 0) d.sd = relative_sd * d.y;
}

}  // namespace granulaw
