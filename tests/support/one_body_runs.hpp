#pragma once

#include <algorithm>

#include "characterise/pair/two_body_runs.hpp"
#include "solver/runs.hpp"

namespace granulaw::tests {

/// The one sphere that stands for a pair by the rule. F = lambda Y R*^2 Phi(d/(lambda R*)) with m* moves like a sphere
/// of radius lambda R* and mass lambda m* on the rigid wall under lambda F. Units of the yielding body.
inline Particle one_body(const UnlikePair& pair)
{
  UnlikePair equal = pair;
  equal.radius_ratio = 1;
  Particle sphere = TwoBodies(equal).first;
  sphere.radius = pair.mapping().length(pair.r_eff());
  sphere.materials[0].density = pair.one_body_density();
  return sphere;
}

/// F of the pair is that of the one body over lambda.
inline RunSummary of_pair(RunSummary s, const UnlikePair& pair)
{
  const double lambda = pair.mapping().length(1.0);
  s.force_max /= lambda, s.work_load /= lambda, s.work_unload /= lambda;
  return s;
}

/// Collision by the rule, computed by the solver: it has the solver's errors and the inertia of a one-body impact, and
/// none of a fitted curve. `velocity`: m/s. Held against run_two_bodies().
inline RunSummary run_as_one_body(const UnlikePair& pair, double velocity, const RunOptions& options)
{
  return of_pair(impact(one_body(pair), {velocity / pair.wave_speed()}, {}, options).summary, pair);
}

/// Slow presses to `depth`, an overlap over lambda R*: no waves. The ramps, `ramp` in R/c* of the larger body, are the
/// same for both. Not for walls.
inline RunSummary press_as_one_body(const UnlikePair& pair, double depth, double ramp, const RunOptions& options)
{
  const Particle sphere = one_body(pair);
  PressPlan plan;
  plan.depth = depth * sphere.radius, plan.ramp = ramp;
  return of_pair(press(sphere, plan, {}, options).summary, pair);
}

inline RunSummary press_two_bodies(const UnlikePair& pair, double depth, double ramp, const RunOptions& options)
{
  const TwoBodies bodies(pair);
  PressPlan plan;
  plan.depth = depth * pair.mapping().length(pair.r_eff());
  plan.ramp = ramp * std::max(1.0, pair.radius_ratio) / bodies.first.radius;
  return press(bodies.first, plan, bodies.partner, options).summary;
}

}  // namespace granulaw::tests
