#include "solver/accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

/// Where the raising starts and ends, cells across the block.
constexpr int first_resolution = 14, last_resolution = 120;
/// Resolution at which time step and ramp are varied: their effect on F and e does not depend on it.
constexpr int probe_resolution = 10;
/// Shares of the tolerance: the square root of the sum of the squares is the whole.
constexpr double share = 0.25;

double difference(const RunSummary& a, const RunSummary& b)
{
  return std::max(std::abs(b.force_max / a.force_max - 1), std::abs(b.restitution / a.restitution - 1));
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

double error_between(const RunSummary& fine, const RunSummary& coarse)
{
  // Errors fall at least like h: the difference to 0.7 of the resolution is at least 0.4 of the fine run's.
  // Two runs may agree by chance: the ripple that the mean over the shifted grids has left, and the scatter
  // of e between them, bound it from below.
  const double scatter = fine.restitution_spread / fine.restitution / std::max(1, fine.grids);
  return 2 * std::max({difference(fine, coarse), scatter, 0.25 * fine.ripple});
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
  const RunSummary coarse = run(own).summary;
  fine.summary.error_estimate = error_between(fine.summary, coarse);
  add_cost(fine.summary, coarse);
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
    const RunSummary s = run(o).summary;
    add_cost(spent, s);
    return s;
  };

  RunSummary base = probe(own);
  // The scheme is of second order in the step: half the step leaves a quarter of the error.
  for (;;) {
    RunOptions half = own;
    half.courant = 0.5 * own.courant;
    const RunSummary finer = probe(half);
    found.step_error = 4.0 / 3.0 * difference(base, finer);
    if (found.step_error <= share * tolerance || half.courant < 0.1) break;
    own = half, base = finer;
  }
  // What the ramp adds falls like its inverse square (inertia) or faster.
  while (has_ramp) {
    RunOptions slower = own;
    slower.slowness = 2 * own.slowness;
    const RunSummary calmer = probe(slower);
    found.ramp_error = 4.0 / 3.0 * difference(base, calmer);
    if (found.ramp_error <= share * tolerance || slower.slowness > 16) break;
    own = slower, base = calmer;
  }

  RunSummary coarse{};
  for (int n = std::max(first_resolution, options.resolution);; n = static_cast<int>(std::lround(n / 0.7))) {
    own.fields = options.fields;
    own.resolution = n;
    if (coarse.resolution == 0) {
      RunOptions first = own;
      first.resolution = coarse_partner(n);
      first.fields = {};
      coarse = run(first).summary;
      add_cost(spent, coarse);
    }
    found.result = run(own);
    RunSummary& s = found.result.summary;
    found.resolution_error = error_between(s, coarse);
    s.error_estimate = std::hypot(found.resolution_error, found.step_error, found.ramp_error);
    found.reached = s.error_estimate <= tolerance;
    if (found.reached || n / 0.7 > last_resolution) break;
    coarse = s;
    add_cost(spent, s);
  }
  add_cost(found.result.summary, spent);
  return found;
}

}  // namespace granulaw
