#include "calibrate/misfit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibrate/kind/composed.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

bool Factors::seen(int k, double model) const
{
  const double size = std::abs(value[k]);
  return (scatter < 1 && size > clear_by_scatter * std::hypot(scatter * sd[k], model)) ||
         size > clear_by_stated * std::hypot(std::max(1.0, scatter) * sd[k], model);
}

Factors legendre_factors(const Differences& d)
{
  const auto rows = static_cast<Eigen::Index>(d.place.size());
  Eigen::MatrixXd a(rows, 3);
  Eigen::VectorXd b(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double t = d.place[i], w = 1 / d.sd[i];
    a.row(k) << w, w * t, w * 0.5 * (3 * t * t - 1);
    b(k) = w * d.relative[i];
  }
  Eigen::Matrix3d information = a.transpose() * a;
  information.diagonal().array() += 1e-9;
  const Eigen::Matrix3d inverse = information.inverse();
  const Eigen::Vector3d x = inverse * (a.transpose() * b);
  Factors f{};
  for (int k = 0; k < 3; ++k) f.value[k] = x(k), f.sd[k] = std::sqrt(inverse(k, k));
  const auto left = static_cast<double>(rows - 3);
  f.scatter = left > 2 ? (b - a * x).norm() / std::sqrt(left) : 1.0;
  return f;
}

double missing_runs(const std::vector<double>& values)
{
  double plus = 0, minus = 0, runs = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    (values[k] > 0 ? plus : minus) += 1;
    if (k == 0 || (values[k] > 0) != (values[k - 1] > 0)) runs += 1;
  }
  const double n = plus + minus;
  if (n < 8 || plus == 0 || minus == 0) return 0;
  const double mean = 2 * plus * minus / n + 1;
  const double variance = (mean - 1) * (mean - 2) / (n - 1);
  return variance > 0 ? (mean - runs) / std::sqrt(variance) : 0;
}

Inspection::Inspection(const CalibrationProblem& problem, const Minimum& minimum, std::size_t index)
    : measurement(problem.request().measurements[index]),
      comparison(problem.compare(minimum.q, index)),
      problem_(problem),
      minimum_(minimum),
      index_(index)
{
}

void Inspection::add_to(Differences& d, std::size_t datum, double place) const
{
  const double predicted = comparison.predicted[datum];
  d.place.push_back(place);
  d.relative.push_back(measurement.data[datum].y / predicted - 1);
  d.sd.push_back(comparison.sd[datum] / predicted);
}

double Inspection::model_error() const
{
  constexpr double by_runs_error = 0.003;  // of a law by runs
  const CandidateMaterial fitted = problem_.material(minimum_.q);
  const double atlas =
      measurement.kind->model_error(errors_of(problem_.laws().atlas(), MaterialRatios::of(fitted).stiffness));
  double composed = 0;
  if (const ComposedModel* model = problem_.composed(index_)) {
    const ComposedError error = model->error(fitted);
    composed = measurement.kind->counterpart == Kind::Counterpart::wall ? error.restitution : error.force;
  }
  return std::hypot(atlas, fitted.hardens_linearly() ? 0.0 : by_runs_error, composed) /
         std::sqrt(std::min(3.0, static_cast<double>(measurement.kind->smooth_errors)));
}

std::vector<double> Inspection::model_errors() const
{
  std::vector<double> taken;
  for (std::size_t u = 0; u < problem_.count(); ++u)
    if (problem_.unknowns()[u].is_model_error() && problem_.unknowns()[u].measurement == problem_.sharer(index_))
      taken.push_back(minimum_.q[static_cast<Eigen::Index>(u)]);
  return taken;
}

double Inspection::above() const
{
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < measurement.data.size(); ++k) {
    const double predicted = comparison.predicted[k];
    if (!(predicted > 0) || !measurement.kind->tells_strength(measurement, k, predicted)) continue;
    const double weight = std::pow(predicted / comparison.sd[k], 2);
    sum += weight * (measurement.data[k].y / predicted - 1), weights += weight;
  }
  return weights > 0 ? sum / weights / std::hypot(1 / std::sqrt(weights), model_error()) : 0;
}

void Inspection::look_for_outliers()
{
  constexpr double clear = 4;  // standard deviations
  const std::size_t count = measurement.data.size();
  std::vector<std::size_t> off;
  const auto residual = [&](std::size_t k) {
    return (measurement.data[k].y - comparison.with_errors[k]) / comparison.sd[k];
  };
  for (std::size_t k = 0; k < count; ++k)
    if (std::abs(residual(k)) > clear + (count > 100 ? 1 : 0)) off.push_back(k);
  if (off.empty() || off.size() > std::max<std::size_t>(1, count / 10)) return;
  std::string lines;
  for (const std::size_t k : off) {
    if (!lines.empty()) lines += ", ";
    lines += fmt::format("{} ({:+.1f} sd)", measurement.data[k].line, residual(k));
    if (lines.size() > 100) break;
  }
  say(misfit_of_outliers, fmt::format("single values lie far off the fit, in line {}: outliers count less", lines));
}

namespace {

/// Impacts that show another strength than slow measurements of the same material.
std::optional<Misfit> contradiction(const std::vector<Inspection>& inspections)
{
  constexpr double agrees = 1;  // the side that has more values pulls the fit to itself
  double fast = 0, slow = 0;
  bool has_fast = false, has_slow = false;
  for (const Inspection& i : inspections) {
    const Kind::Shows shows = i.measurement.kind->shows;
    if (shows == Kind::Shows::neither) continue;
    (shows == Kind::Shows::fast ? has_fast : has_slow) = true;
    double& side = shows == Kind::Shows::fast ? fast : slow;
    if (const double above = i.above(); std::abs(above) > std::abs(side)) side = above;
  }
  const bool same_side = (fast > 0) == (slow > 0) && std::min(std::abs(fast), std::abs(slow)) > agrees;
  if (!has_fast || !has_slow || same_side || std::max(std::abs(fast), std::abs(slow)) < clear_by_stated)
    return std::nullopt;
  return Misfit{
      "", fast > slow ? "rate" : "slow is stronger",
      fast > slow
          ? "impacts show a stronger material than slow measurements do: its yield stress grows with the "
            "strain rate, which this fit does not know"
          : "slow measurements show a stronger material than impacts do: losses that are not plastic, or "
            "specimens that differ"};
}

}  // namespace

std::vector<Misfit> name_misfits(const CalibrationProblem& problem, const Minimum& minimum)
{
  std::vector<Misfit> all;
  std::vector<Inspection> inspections;
  for (std::size_t k = 0; k < problem.request().measurements.size(); ++k)
    inspections.emplace_back(problem, minimum, k);
  if (const std::optional<Misfit> found = contradiction(inspections)) all.push_back(*found);
  for (Inspection& inspection : inspections) {
    inspection.measurement.kind->inspect(inspection);
    inspection.look_for_outliers();
    for (Misfit& m : inspection.found) all.push_back(std::move(m));
  }
  return all;
}

}  // namespace granulaw
