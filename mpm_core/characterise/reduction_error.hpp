#pragma once

#include "characterise/fit_curve.hpp"
#include "law/law.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// Two spheres of different make, or sizes, that touch pole against pole; or a sphere and a thick wall. Only
/// ratios count: lengths over the first one's radius.
struct UnlikePair
{
  LawMaterial yielding;     ///< whose law the pair rule takes: the lower yield stress
  LawMaterial partner;      ///< may be elastic, or yield as well
  double radius_ratio = 1;  ///< partner's radius over the yielding body's; infinity: a deformable wall

  /// The rule's mapping for this pair (contact/pair.hpp).
  PairMapping mapping() const { return PairMapping::deformable_partner(yielding.e_star(), partner.e_star()); }
  /// R* and m*, in units of the yielding body's radius and, of mass, of its density times radius cubed.
  double r_eff() const { return 1.0 / (1.0 + 1.0 / radius_ratio); }
  double m_eff() const;
  /// Density, over the yielding body's, of the one sphere that stands for the pair: see `as_one_body`.
  double one_body_density() const;
  /// v of the velocity axis in the rule's coordinates (contact/axis.hpp) over the square root of the
  /// damage number (law/damage_number.hpp), at one relative speed. 1 between like spheres and on a rigid wall.
  double axis_speed_ratio() const;
  /// Customary V_y of that sphere, m/s: the relative velocity that V/V_y of a pair is counted from.
  double yield_velocity() const;
};

/// What the pair rule costs one pair at one velocity, relative (0.01 is 1 %).
struct ReductionError
{
  double force = 0;        ///< of F_max
  double restitution = 0;  ///< of e
  /// Of an estimate: the pair and its velocity lie where the rule was held against two-body runs.
  bool within_measured = true;
};

/// Bound of the error of F_max and e of a collision at the relative `velocity` (m/s, > 0) by the pair rule,
/// from pairs.csv of tests/validation (docs/evidence/pairs.md): at least 95 % of the measured collisions lie
/// below it, typically at a third. Never below 0.002, what the measurements resolve. Grows with the velocity,
/// so that a law's certificate takes the largest velocity it is meant for (`fastest_of_law`). Four causes add
/// up:
/// - a stronger partner stays elastic, and the rule lets it yield along: Y_h/Y_s, E_s/E_h;
/// - a finite body is stiffer than its half-space, and the rule counts as if both were like the yielding one;
/// - the smaller of two unlike spheres gives way more than its half of the overlap: radii and depth;
/// - waves in the larger one are lost, where a like one gives them back: radii and V/c.
/// `within_measured`: E*_h >= 0.3 E*_s, Y_h >= Y_s, radii 1:10 to 10:1 or a wall, I of the one body up to
/// 0.003, Hertz's overlap below 0.13 R*. Else the numbers are an extrapolation: `measure_reduction_error`
/// instead. The yielding body must yield; an elastic pair has only the second and the fourth cause, not
/// bounded here.
ReductionError estimate_reduction_error(const UnlikePair& pair, double velocity);

/// Bound of what a law of the pair's own (two_body_law.hpp), made at the radius ratio `law_radius_ratio`,
/// costs at pair.radius_ratio and the relative `velocity` (m/s): the last three causes, as far as they change
/// with the radii; 0 at its own ratio. What that law's certificate states comes on top.
ReductionError estimate_remaining_error(const UnlikePair& pair, double law_radius_ratio, double velocity);

/// Relative velocity, m/s, at which v^2 of the velocity axis, rho V^2/Y of the pair's one body, is
/// `axis_speed2`.
double fastest_of_law(const UnlikePair& pair, double axis_speed2);

/// The same measured: two collisions, as two bodies and as one, at two resolutions; about a second of CPU at
/// E*/Y = 100 and V/V_y = 20, ten times that at E*/Y = 1000. Signed: rule over two bodies, less 1.
struct MeasuredReduction
{
  ReductionError error;
  double solver_force = 0;        ///< what the two resolutions leave open, of force
  double solver_restitution = 0;  ///< and of e
};
MeasuredReduction measure_reduction_error(const UnlikePair& pair, double velocity);

/// What the rule says of a pair's collision, by the solver: F = lambda Y R*^2 Phi(d/(lambda R*)) with m*
/// moves like a sphere of radius lambda R* and mass lambda m* on the rigid wall under lambda F. So one free
/// impact of that sphere at the relative velocity is the rule's answer, with the solver's errors and the
/// inertia of a one-body impact, and without those of a fitted curve. `run_two_bodies` is the truth it is
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
