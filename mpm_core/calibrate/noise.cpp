#include "calibrate/noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

/// Residual of a force from the cubic through its four neighbours, and the sum of its squared weights: of the
/// data, and of the rows that they are means of.
struct PseudoResidual
{
  double force, residual, data, rows;
};

std::vector<PseudoResidual> pseudo_residuals(const Measurement& m)
{
  constexpr double most_gain = 20;  // of the scatter: neighbours too unevenly spaced
  // the branches' ends: a row belongs to one before and one from there on
  std::vector<std::size_t> ends;
  for (const Unloading& u : m.unloadings()) {
    const auto at = [&](std::size_t k) { return m.data.begin() + static_cast<std::ptrdiff_t>(k); };
    const auto lowest =
        std::min_element(at(u.first), at(u.last), [](const Datum& a, const Datum& b) { return a.x < b.x; });
    ends.insert(ends.end(), {u.first, static_cast<std::size_t>(lowest - m.data.begin()) + 1, u.last});
  }
  std::vector<PseudoResidual> found;
  for (std::size_t k = 2; k + 2 < m.data.size(); ++k) {
    if (std::any_of(ends.begin(), ends.end(), [&](std::size_t end) { return k - 2 < end && end <= k + 2; }))
      continue;
    const std::size_t neighbours[] = {k - 2, k - 1, k + 1, k + 2};
    double cubic = 0, data = 1, rows = 1.0 / m.data[k].rows;
    for (const std::size_t i : neighbours) {
      double weight = 1;
      for (const std::size_t j : neighbours)
        if (j != i) weight *= (m.data[k].x - m.data[j].x) / (m.data[i].x - m.data[j].x);
      cubic += weight * m.data[i].y, data += weight * weight, rows += weight * weight / m.data[i].rows;
    }
    if (data < most_gain) found.push_back({std::abs(cubic), m.data[k].y - cubic, data, rows});
  }
  return found;
}

}  // namespace

double ForceScatter::at(double force, int rows) const
{
  return std::hypot(constant, share * force) / (averages ? std::sqrt(rows) : 1.0);
}

namespace {

ForceScatter likeliest(const Measurement& curve, std::initializer_list<bool> ways)
{
  constexpr double least = 1e-4, most = 0.3;  // of the largest force, and of the fraction
  constexpr int steps = 32;
  const std::vector<PseudoResidual> residuals = pseudo_residuals(curve);
  const double unit = curve.largest_y();
  ForceScatter best{0.01 * unit, 0};
  double best_cost = std::numeric_limits<double>::infinity();
  if (residuals.size() < 3) return best;
  for (const bool averages : ways)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j) {
        const ForceScatter s{unit * least * std::pow(most / least, static_cast<double>(i) / steps),
                             least * std::pow(most / least, static_cast<double>(j) / steps), averages};
        double cost = 0;
        for (const PseudoResidual& r : residuals) {
          const double sd = s.at(r.force), variance = sd * sd * (averages ? r.rows : r.data);
          cost += std::log(variance) + r.residual * r.residual / variance;
        }
        if (cost < best_cost) best_cost = cost, best = s;
      }
  return best;
}

}  // namespace

ForceScatter scatter_of(const Measurement& curve)
{
  return likeliest(curve, {false, true});
}

ForceScatter scatter_of_means(const Measurement& means)
{
  return likeliest(means, {true});
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
