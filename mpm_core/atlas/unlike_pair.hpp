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

/// Relative velocity, m/s, at which v^2 of the velocity axis, rho V^2/Y of the pair's one body, is
/// `axis_speed2`.
double fastest_of_law(const UnlikePair& pair, double axis_speed2);

/// The two as the pair rule sees them, at this ratio of the partner's radius to the yielding body's.
UnlikePair unlike_pair(const LawMaterial& a, const LawMaterial& b, double radius_ratio = 1);

}  // namespace granulaw
