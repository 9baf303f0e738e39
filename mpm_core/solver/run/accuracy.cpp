#include "solver/run/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/larger.hpp"
#include "solver/run/grid_noise.hpp"

namespace granulaw {

namespace {

/// Shares of the tolerance: the square root of the sum of the squares is the whole.
constexpr double share = 0.25;

constexpr int fewest_cells = 6;

/// Largest force by the fit through the loading, which no grid noise moves.
double fitted_force(const RunResult& run)
{
  const TreatedLoading treated(run.trace);
  return treated.valid() ? treated.largest_force(run.summary.delta_max) : run.summary.force_max;
}

/// Difference of two runs, the larger one of force and e, both fitted.
double difference(const RunResult& a, const RunResult& b)
{
  return std::max(std::abs(fitted_force(b) / fitted_force(a) - 1),
                  std::abs(b.summary.restitution / a.summary.restitution - 1));
}

/// Bound on the effect of grid noise on a run's force or e: half of it, or the scatter of e between its
/// grids.
double noise_of(const RunSummary& s)
{
  return std::max(0.5 * s.grid_noise, s.restitution_spread / s.restitution / std::max(1, s.grids));
}

/// Largest relative change of the fitted loading force; of the peak where a loading has too few samples.
double change_of_loading(const RunResult& fine, const RunResult& coarse)
{
  const TreatedLoading a(fine.trace), b(coarse.trace);
  if (!a.valid() || !b.valid()) return std::abs(coarse.summary.force_max / fine.summary.force_max - 1);
  double most = 0;
  for (const double share : {0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    const double x = share * fine.summary.delta_max;
    most = larger(most, std::abs(b.force(x) / a.force(x) - 1));
  }
  return most;
}

bool is_spatial(const RunResult& run)
{
  return !run.planes.empty();
}

const CellsRule& rule_of(const RunResult& run)
{
  return is_spatial(run) ? spatial_rule : rule_of_revolution;
}

double cell_ratio(const RunResult& fine, const RunResult& coarse)
{
  return static_cast<double>(fine.summary.resolution) / coarse.summary.resolution;
}

void add_cost(RunSummary& s, const RunSummary& other)
{
  const double updates = s.point_updates_per_s * s.cpu_s + other.point_updates_per_s * other.cpu_s;
  s.cpu_s += other.cpu_s;
  s.steps += other.steps;
  s.point_updates_per_s = updates / s.cpu_s;
}

}  // namespace

int coarse_partner(int resolution)
{
  return std::max(fewest_cells, static_cast<int>(std::lround(0.7 * resolution)));
}

int finer_rung(int resolution)
{
  return static_cast<int>(std::lround(resolution / 0.7));
}

double CellsRule::left(double change, double cell_ratio) const
{
  return safety * change / (std::pow(cell_ratio, order) - 1);
}

double CellsRule::left(std::span<const double> changes, double cell_ratio) const
{
  const auto count = static_cast<double>(changes.size());
  double mean = 0, squares = 0;
  for (const double change : changes) mean += change / count;
  for (const double change : changes) squares += (change - mean) * (change - mean);
  return std::hypot(left(mean, cell_ratio), std::sqrt(2 * squares / (count - 1)));
}

CellsError error_of_cells(const RunResult& fine, const RunResult& coarse)
{
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const double ratio = cell_ratio(fine, coarse);
  if (!(ratio > 1)) return {unknown, unknown};
  const CellsRule& rule = rule_of(fine);
  const double force = change_of_loading(fine, coarse);
  const double e = std::abs(coarse.summary.restitution / fine.summary.restitution - 1);
  return {rule.left(force, ratio), rule.left(larger(force, e), ratio)};
}

double error_between(const RunResult& fine, const RunResult& coarse)
{
  const double of_change = error_of_cells(fine, coarse).restitution, ratio = cell_ratio(fine, coarse);
  if (std::isinf(of_change)) return of_change;
  // In three dimensions both runs are single grids, whose noise is multiplied, too.
  if (is_spatial(fine))
    return std::hypot(of_change, spatial_rule.left(std::hypot(noise_of(fine.summary), noise_of(coarse.summary)), ratio));
  return larger(of_change, rule_of_revolution.left(noise_of(fine.summary), ratio));
}

RunResult run_with_estimate(const RunOptions& options, const Run& run)
{
  RunOptions own = options;
  own.estimate_error = false;
  double from = 0, to = 0.7;  // cost goes with the third power: 0.7^3 = 1/3
  own.progress = [&](double done) {
    if (options.progress) options.progress(from + (to - from) * done);
  };
  RunResult fine = run(own);
  own.refine = 1;  // it is in the fine run's resolution
  own.fields = {};
  from = 0.7, to = 1.0;
  fine.summary.error_estimate = std::numeric_limits<double>::infinity();
  for (int cells = fine.summary.resolution; cells > fewest_cells;) {
    own.resolution = cells = coarse_partner(cells);
    const RunResult coarse = run(own);
    add_cost(fine.summary, coarse.summary);
    fine.summary.error_estimate = error_between(fine, coarse);
    if (std::isfinite(fine.summary.error_estimate)) break;
  }
  return fine;
}

namespace {

/// Order by which the error fell with the cells. Just above the onset of a stiff body it is less than the rule's; below
/// half of that a difference is noise.
double order_between(const RunResult& fine, double error, const RunResult& coarse, double error_of_coarse)
{
  const double seen = std::log(error_of_coarse / error) / std::log(cell_ratio(fine, coarse)), most = rule_of(fine).order;
  return std::clamp(seen, 0.5 * most, most);
}

/// From a run's cost and its error estimate by two resolutions, which falls by this order of the cells.
ToleranceForecast forecast_of(const RunResult& run, double tolerance, double error_of_cells, double order)
{
  const double power = is_spatial(run) ? 4 : 3;  // of the cost: cells, and steps
  const RunSummary& s = run.summary;
  ToleranceForecast forecast{s.resolution, s.error_estimate, s.resolution, 0};
  const auto scaled = [&](int cells) { return static_cast<double>(cells) / s.resolution; };
  while (error_of_cells * std::pow(scaled(forecast.wanted_cells), -order) > tolerance) {
    forecast.wanted_cells = finer_rung(forecast.wanted_cells);
    forecast.cpu_s += s.cpu_s * std::pow(scaled(forecast.wanted_cells), power);
  }
  return forecast;
}

/// The search of run_to_tolerance: each step refines `options` and notes what error is left.
class ToleranceSearch
{
 public:
  ToleranceSearch(double tolerance, const RunOptions& options, const Run& run, const ToleranceRange& range)
      : tolerance_(tolerance), options_(options), run_(run), range_(range)
  {
    options_.estimate_error = false;
    base_ = probe(options_);
  }

  /// The scheme is of second order in the step: half the step leaves a quarter of the error.
  void shorten_step() { refine(&RunOptions::courant, 0.5, 0.1, found_.step_error); }
  /// The ramp's error falls like its inverse square (inertia) or faster.
  void lengthen_ramp() { refine(&RunOptions::slowness, 2, 16, found_.ramp_error); }

  ToleranceResult raise_resolution(const std::function<void(const ToleranceForecast&)>& forecast)
  {
    int cells = std::max(range_.first, options_.resolution);
    RunResult coarse = run_at(options_, coarse_partner(cells));
    add_cost(spent_, coarse.summary);
    double order = rule_of(coarse).order;
    for (double last_error = 0;; cells = finer_rung(cells)) {
      options_.resolution = cells;
      found_.result = run_(options_);
      RunSummary& s = found_.result.summary;
      found_.resolution_error = error_between(found_.result, coarse);
      s.error_estimate = std::hypot(found_.resolution_error, found_.step_error, found_.ramp_error);
      found_.reached = s.error_estimate <= tolerance_;
      if (found_.reached || finer_rung(cells) > range_.last) break;
      if (last_error > 0) order = order_between(found_.result, found_.resolution_error, coarse, last_error);
      last_error = found_.resolution_error;
      if (forecast && std::isfinite(last_error)) forecast(forecast_of(found_.result, tolerance_, found_.resolution_error, order));
      add_cost(spent_, s);
      coarse = std::move(found_.result);
    }
    add_cost(found_.result.summary, spent_);
    return std::move(found_);
  }

 private:
  /// Without fields: those shown are the finest run's.
  RunResult run_at(RunOptions options, int cells)
  {
    options.resolution = cells;
    options.fields = {};
    return run_(options);
  }
  RunResult probe(const RunOptions& options)
  {
    RunResult probed = run_at(options, range_.probe);
    add_cost(spent_, probed.summary);
    return probed;
  }
  /// Changes an option by `factor`, again and again up to `last`, until the probe with the next value differs
  /// by no more than its fraction of the tolerance; `error` becomes the error that is left.
  void refine(double RunOptions::*option, double factor, double last, double& error)
  {
    for (;;) {
      RunOptions finer = options_;
      finer.*option *= factor;
      RunResult probed = probe(finer);
      error = 4.0 / 3.0 * difference(base_, probed);
      const bool ends = factor < 1 ? finer.*option < last : finer.*option > last;
      if (error <= share * tolerance_ || ends) return;
      options_ = finer;
      base_ = std::move(probed);
    }
  }

  double tolerance_;
  RunOptions options_;
  const Run& run_;
  const ToleranceRange& range_;
  RunResult base_;  ///< probe with the options so far
  RunSummary spent_{};
  ToleranceResult found_;
};

}  // namespace

ToleranceResult run_to_tolerance(double tolerance, bool has_ramp, const RunOptions& options, const Run& run,
                                 const ToleranceRange& range,
                                 const std::function<void(const ToleranceForecast&)>& forecast)
{
  ToleranceSearch search(tolerance, options, run, range);
  search.shorten_step();
  if (has_ramp) search.lengthen_ramp();
  return search.raise_resolution(forecast);
}

}  // namespace granulaw
