#include "calibrate/design.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double normal95 = 1.959964;
constexpr int curve_rows = 60;  // loading rows of a curve; half as many unload

/// A curve between platens to this displacement, its forces still 0.
Measurement curve_to(double displacement, double radius)
{
  Measurement m;
  m.kind = MeasurementKind::platens;
  m.source = "a curve";
  m.radius = radius;
  m.fit_offset = true;
  for (int k = 1; k <= curve_rows; ++k) m.data.push_back({displacement * k / curve_rows, 1, 1, k});
  for (int k = curve_rows / 2; k > 0; --k)
    m.data.push_back({displacement * (0.5 + k / (curve_rows + 2.0)), 1, 1, 2 * curve_rows - k});
  return m;
}

/// Fills in what this material would show.
void fill(Measurement& m, const CandidateMaterial& material, const Atlas& atlas, double relative_sd)
{
  SphereLawsCache cache(atlas);
  const SphereLaws& laws = cache.of(material);
  const std::vector<double> values = predict(m, material, laws, {}).values;
  const double largest = *std::max_element(values.begin(), values.end());
  for (std::size_t k = 0; k < values.size(); ++k) {
    m.data[k].y = values[k];
    m.data[k].sd = relative_sd * std::max(values[k], 0.01 * largest);
  }
}

}  // namespace

Design::Design(const Atlas& atlas, CalibrationRequest request, const CandidateMaterial& assumed,
               std::vector<DesignCandidate> candidates, double radius, double relative_sd)
    : candidates_(std::move(candidates))
{
  if (candidates_.empty()) fail("design", "no measurement is to be considered");
  std::size_t rows_there = 0;
  for (const Measurement& m : request.measurements) rows_there += m.data.size();
  // all impacts are one measurement, whose model errors they share; each curve is one of its own
  Measurement impacts;
  impacts.source = "impacts";
  impacts.radius = radius;
  std::vector<Measurement> curves;
  std::vector<std::size_t> rows, counts;
  for (const DesignCandidate& c : candidates_)
    if (!is_curve(c.kind)) impacts.data.push_back({c.place, 1, 1, 1});
  const std::size_t impact_rows = impacts.data.size();
  if (impact_rows > 0) {
    fill(impacts, assumed, atlas, relative_sd);
    request.measurements.push_back(impacts);
  }
  std::size_t next_impact = rows_there, next_curve = rows_there + impact_rows;
  for (const DesignCandidate& c : candidates_) {
    if (!is_curve(c.kind)) {
      rows.push_back(next_impact++), counts.push_back(1);
      continue;
    }
    Measurement curve = curve_to(c.place, radius);
    fill(curve, assumed, atlas, relative_sd);
    rows.push_back(next_curve), counts.push_back(curve.data.size());
    next_curve += curve.data.size();
    request.measurements.push_back(std::move(curve));
  }
  request.robust = false;
  const CalibrationProblem problem(atlas, std::move(request));
  Coordinates q = Coordinates::Zero(static_cast<Eigen::Index>(problem.count()));
  for (std::size_t k = 0; k < problem.request().fit.size(); ++k) {
    const Parameter p = problem.request().fit[k];
    q[static_cast<Eigen::Index>(k)] = problem.coordinate(k, value_of(assumed, p));
    const double value = value_of(assumed, p);
    shares_.push_back(p == Parameter::hardening_modulus
                          ? (value + problem.unknowns()[k].scale) / (value + 0.5 * assumed.yield_stress)
                          : 1.0);
  }
  const Eigen::MatrixXd jacobian = jacobian_at(problem, q);
  const auto block = [&](std::size_t first, std::size_t count) {
    const auto part = jacobian.middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    return Eigen::MatrixXd(part.transpose() * part);
  };
  const auto all = static_cast<std::size_t>(jacobian.rows());
  there_ = block(0, rows_there) + block(problem.data_count(), all - problem.data_count());
  there_.diagonal().array() += 1e-6;  // what nothing tells
  for (std::size_t k = 0; k < candidates_.size(); ++k) information_.push_back(block(rows[k], counts[k]));
}

Eigen::MatrixXd Design::information(const std::vector<std::size_t>& chosen) const
{
  Eigen::MatrixXd sum = there_;
  for (const std::size_t k : chosen) sum += information_[k];
  return sum;
}

ExpectedIntervals Design::expected(const std::vector<std::size_t>& chosen) const
{
  const Eigen::MatrixXd covariance = information(chosen).inverse();
  ExpectedIntervals widths;
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    widths.push_back(normal95 * shares_[k] * std::sqrt(covariance(i, i)));
  }
  return widths;
}

double Design::spread(const std::vector<std::size_t>& chosen) const
{
  double sum = 0;
  for (const double width : expected(chosen)) sum += std::log(width);
  return sum;
}

std::vector<std::size_t> Design::best(std::size_t count) const
{
  std::vector<std::size_t> chosen;
  while (chosen.size() < count) {
    std::size_t next = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      chosen.push_back(k);
      if (const double s = spread(chosen); s < least) least = s, next = k;
      chosen.pop_back();
    }
    chosen.push_back(next);
  }
  return chosen;
}

}  // namespace granulaw
