#include "atlas/departure.hpp"

#include <algorithm>
#include <cmath>

#include "atlas/fit_spline.hpp"
#include "law/contact_law.hpp"

namespace granulaw {

namespace {

double coordinate(double over_onset)
{
  return std::pow(std::max(1.0, over_onset), 0.25) - 1;
}

}  // namespace

Departure::Function::Function(const std::vector<Point>& points)
{
  /// Intervals of the coordinate that are shorter follow the vibration of an impact, up to .3 % of its force.
  constexpr double least_interval = 0.25;
  constexpr int fewest = 6, most = 24;
  /// Penalty over the mean weight: it bridges a factor of three between runs and follows each within 1e-3 of a
  /// difference.
  constexpr double stiffness = 0.02;
  if (points.empty()) return;
  std::vector<SplineSample> samples;
  for (const Point& p : points) {
    samples.push_back({coordinate(p.over_onset), p.value, p.weight});
    end_ = std::max(end_, samples.back().q);
  }
  if (samples.size() == 1) {
    SplineSample half = samples.front();
    half.q *= 0.5, half.value *= 0.25;
    samples.push_back(half);
  }
  spline_ = fit_spline(samples, end_, std::clamp(static_cast<int>(end_ / least_interval), fewest, most), stiffness, 2);
}

double Departure::Function::at(double over_onset) const
{
  return spline_.value(std::min(coordinate(over_onset), end_));
}

Departure::Departure(const Points& points)
{
  for (std::size_t f = 0; f < points.size(); ++f) {
    functions_[f] = Function(points[f]);
    for (const Point& p : points[f]) end_ = std::max(end_, p.over_onset);
  }
}

Departure Departure::between(const Curve& own, const LawShape& guide)
{
  constexpr int places = 96;
  const double onset = guide.onset, end = std::min(own.end(), guide.end);
  const ContactLaw law(guide, end);
  Points points;
  for (int k = 1; k <= places; ++k) {
    const double over_onset = std::pow(end / onset, static_cast<double>(k) / places);
    const double x = std::min(end, onset * over_onset);
    const Curve::Top a = own.top(x), b = law.top(x);
    const double difference[] = {-std::log(a.force / b.force), std::log(own.radius(x) / law.radius(x)),
                                 -std::log(a.span / b.span), -std::log(a.kept / b.kept), a.share - b.share};
    for (std::size_t f = 0; f < LawShape::first_radius; ++f) points[f].push_back({over_onset, difference[f]});
    if (!own.states_unloading_radius()) continue;
    const auto k_own = own.unloading_radius(x).k, k_guide = law.unloading_radius(x);
    for (std::size_t j = 0; j < 3; ++j)
      points[LawShape::first_radius + j].push_back({over_onset, k_own[j] - k_guide[j]});
  }
  return Departure(points);
}

void Departure::add_to(LawShape& master) const
{
  for (std::size_t f = 0; f < functions_.size(); ++f)
    for (std::size_t k = 1; k < LawShape::nodes; ++k)
      (master.*LawShape::functions[f])[k] += at(f, master.overlap(k) / master.onset);
}

}  // namespace granulaw
