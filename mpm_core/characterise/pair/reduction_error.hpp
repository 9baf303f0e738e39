#pragma once

#include "atlas/unlike_pair.hpp"
#include "characterise/record/contact_record.hpp"
#include "law/law.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// Collision of a pair by the rule, computed by the solver. F = lambda Y R*^2 Phi(d/(lambda R*)) with m*
/// moves like a sphere of radius lambda R* and mass lambda m* on the rigid wall under lambda F. So one free
/// impact of that sphere at the relative velocity is the rule's result. It has the solver's errors and the
/// inertia of a one-body impact, and none of a fitted curve. `run_two_bodies` is the reference
/// held against. Both in units of the yielding body: R_s = E*_s = rho_s = 1; `velocity` in sqrt(E*_s/rho_s).
RunSummary run_as_one_body(const UnlikePair& pair, double velocity, const RunOptions& options);
RunSummary run_two_bodies(const UnlikePair& pair, double velocity, const RunOptions& options);

RunResult two_body_impact(const UnlikePair& pair, double velocity, const RunOptions& options);

/// A two-body impact in the pair's own coordinates: overlap/(lambda R*), F/(4/3 E*_s lambda R*^2),
/// a/(sqrt(lambda) R*). From several of them, and an elastic one, fit_curve.hpp makes a two-body law: a curve
/// that goes with this pair's mapping, and is valid for this pair, radius ratio and density ratio only.
ContactRecord two_body_record(const UnlikePair& pair, double velocity, const RunOptions& options);

/// The same two of a slow press to `depth`, an overlap over lambda R*: no waves. The ramps, `ramp` in R/c* of
/// the larger body, are the same for both. Not for walls.
RunSummary press_as_one_body(const UnlikePair& pair, double depth, double ramp, const RunOptions& options);
RunSummary press_two_bodies(const UnlikePair& pair, double depth, double ramp, const RunOptions& options);

}  // namespace granulaw
