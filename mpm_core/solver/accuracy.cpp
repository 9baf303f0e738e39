#include "solver/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "solver/grid_noise.hpp"

namespace granulaw {

namespace {

/// Where the raising starts and ends, cells across the block.
constexpr int first_resolution = 14, last_resolution = 120;
/// Resolution at which time step and ramp are varied: their effect on F and e does not depend on it.
constexpr int probe_resolution = 10;
/// Shares of the tolerance: the square root of the sum of the squares is the whole.
constexpr double share = 0.25;

/// Largest force by the fit through the loading, which no grid noise moves.
double fitted_force(const RunResult& run)
{
  const TreatedLoading treated(run.trace);
  return treated.valid() ? treated.largest_force(run.summary.delta_max) : run.summary.force_max;
}

/// Of the fitted force and e.
double difference(const RunResult& a, const RunResult& b)
{
  return std::max(std::abs(fitted_force(b) / fitted_force(a) - 1),
                  std::abs(b.summary.restitution / a.summary.restitution - 1));
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
  return std::max(6, static_cast<int>(std::lround(0.7 * resolution)));
}

double error_between(const RunResult& fine, const RunResult& coarse)
{
  const RunSummary& s = fine.summary;
  // Errors fall at least like h: the difference to 0.7 of the resolution is at least 0.4 of the fine run's.
  // Two runs may agree by chance: the grid noise that the mean over the shifted grids has left, half of which
  // a peak may be off, and the scatter of e between them, bound it from below.
  const double peak = std::abs(coarse.summary.force_max / s.force_max - 1);
  const double scatter = s.restitution_spread / s.restitution / std::max(1, s.grids);
  return 2 * std::max({difference(fine, coarse), peak, scatter, 0.5 * s.grid_noise});
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
  own.resolution = coarse_partner(fine.summary.resolution);
  own.refine = 1;  // it is in the fine run's resolution
  own.fields = {};
  from = 0.7, to = 1.0;
  const RunResult coarse = run(own);
  fine.summary.error_estimate = error_between(fine, coarse);
  add_cost(fine.summary, coarse.summary);
  return fine;
}

ToleranceResult run_to_tolerance(double tolerance, bool has_ramp, const RunOptions& options, const Run& run)
{
  ToleranceResult found;
  RunOptions own = options;
  own.estimate_error = false;
  RunSummary spent{};
  const auto probe = [&](const RunOptions& changed) {
    RunOptions o = changed;
    o.resolution = probe_resolution;
    o.fields = {};
    RunResult probed = run(o);
    add_cost(spent, probed.summary);
    return probed;
  };

  RunResult base = probe(own);
  // The scheme is of second order in the step: half the step leaves a quarter of the error.
  for (;;) {
    RunOptions half = own;
    half.courant = 0.5 * own.courant;
    RunResult finer = probe(half);
    found.step_error = 4.0 / 3.0 * difference(base, finer);
    if (found.step_error <= share * tolerance || half.courant < 0.1) break;
    own = half, base = std::move(finer);
  }
  // What the ramp adds falls like its inverse square (inertia) or faster.
  while (has_ramp) {
    RunOptions slower = own;
    slower.slowness = 2 * own.slowness;
    RunResult calmer = probe(slower);
    found.ramp_error = 4.0 / 3.0 * difference(base, calmer);
    if (found.ramp_error <= share * tolerance || slower.slowness > 16) break;
    own = slower, base = std::move(calmer);
  }

  RunResult coarse{};
  for (int n = std::max(first_resolution, options.resolution);; n = static_cast<int>(std::lround(n / 0.7))) {
    own.fields = options.fields;
    own.resolution = n;
    if (coarse.summary.resolution == 0) {
      RunOptions first = own;
      first.resolution = coarse_partner(n);
      first.fields = {};
      coarse = run(first);
      add_cost(spent, coarse.summary);
    }
    found.result = run(own);
    RunSummary& s = found.result.summary;
    found.resolution_error = error_between(found.result, coarse);
    s.error_estimate = std::hypot(found.resolution_error, found.step_error, found.ramp_error);
    found.reached = s.error_estimate <= tolerance;
    if (found.reached || n / 0.7 > last_resolution) break;
    add_cost(spent, s);
    coarse = std::move(found.result);
  }
  add_cost(found.result.summary, spent);
  return found;
}

}  // namespace granulaw
