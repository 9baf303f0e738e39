#pragma once

#include "contact/pair.hpp"
#include "law/law_material.hpp"

namespace granulaw {

/// Two spheres of different make, or sizes, that touch pole against pole; or a sphere and a deformable wall.
/// Only ratios count: lengths over the first one's radius.
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
  double wave_speed() const;  ///< sqrt(E*_s/rho_s), m/s: velocities of runs are over this
  /// Density, over the yielding body's, of the one sphere that stands for the pair: see `as_one_body`.
  double one_body_density() const;
  /// v of the velocity axis in the rule's coordinates (contact/axis.hpp) over the square root of the
  /// damage number (law/damage_number.hpp), at one relative speed. 1 between like spheres and on a rigid wall.
  double axis_speed_ratio() const;
  /// Customary V_y of that sphere, m/s: the relative velocity that V/V_y of a pair is counted from.
  double yield_velocity() const;
};

/// Error of the pair rule for one pair at one velocity, relative (0.01 is 1 %).
struct ReductionError
{
  double force = 0;        ///< of F_max
  double restitution = 0;  ///< of e
  /// True if the pair and its velocity lie where the rule was compared with two-body runs.
  bool within_measured = true;
};

/// Bound of the error of F_max and e of a collision at the relative `velocity` (m/s, > 0) by the pair rule,
/// from pairs.csv of tests/validation (docs/evidence/pairs.md): at least 95 % of the measured collisions lie
/// below it, typically at a half. Never below 0.002, what the measurements resolve. Grows with the velocity,
/// so that a law's certificate takes the largest velocity it is meant for (`fastest_of_law`). Three causes add
/// up:
/// - a stronger partner stays elastic, and the rule lets it yield along: Y_h/Y_s, E_s/E_h;
/// - a finite body is stiffer than its half-space, and the rule counts as if both were like the yielding one;
/// - the smaller of two unlike spheres gives way more than its half of the overlap: radii and depth. What waves in the
///   larger one take lies below the same bound.
/// `within_measured`: E*_h >= 0.3 E*_s, Y_h >= Y_s, radii 1:10 to 10:1 or a wall, I of the one body up to
/// 0.003, Hertz's overlap below 0.13 R*. Else the numbers are an extrapolation: `run_two_bodies` computes the
/// collision. The yielding body must yield; an elastic pair has only the second cause and waves, not bounded
/// here.
ReductionError estimate_reduction_error(const UnlikePair& pair, double velocity);

/// Bound of what a law of the pair's own (two_body_law.hpp), made at the radius ratio `law_radius_ratio`,
/// costs at pair.radius_ratio and the relative `velocity` (m/s): the last two causes, as far as they change
/// with the radii; 0 at its own ratio. What that law's certificate states comes on top.
ReductionError estimate_remaining_error(const UnlikePair& pair, double law_radius_ratio, double velocity);

/// Relative velocity, m/s, at which v^2 of the velocity axis, rho V^2/Y of the pair's one body, is
/// `axis_speed2`.
double fastest_of_law(const UnlikePair& pair, double axis_speed2);

/// The two as the pair rule sees them, at this ratio of the partner's radius to the yielding body's.
UnlikePair unlike_pair(const LawMaterial& a, const LawMaterial& b, double radius_ratio = 1);

/// Error of the pair's law, whichever of the two bodies is `radius_ratio` times the larger, to the end of the
/// range that the pair rule was measured in: by the rule (docs/evidence/pairs.md).
ReductionError pair_rule_error(const LawMaterial& a, const LawMaterial& b, double radius_ratio);
/// The same of the pair's own law, made at the radius ratio `law_radius_ratio`.
ReductionError own_law_error(const LawMaterial& a, const LawMaterial& b, double radius_ratio,
                             double law_radius_ratio);

}  // namespace granulaw
