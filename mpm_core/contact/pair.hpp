#pragma once

#include <cmath>

namespace granulaw {

/// Answer of a contact to the particle code.
struct Answer
{
  double force;           ///< N, repulsive positive
  double stiffness;       ///< dF/d(overlap) on the branch, N/m
  double contact_radius;  ///< m
  double delta_max;  ///< m, the new largest overlap since first touch: store it if this call advances time
};

/// The one rule that carries a one-body law (a sphere on a rigid wall) to every pair (docs/theory/pairs.md).
///
/// A yielding body s touches a partner h:
///     F = lambda Y_s R*^2 Phi(d/(lambda R*)),   sqrt(lambda) = 1 + E*_s/E*_h,   R* = R_i R_j/(R_i + R_j).
/// Rigid partner: lambda = 1. Same material: lambda = 4, so that each sphere meets a rigid symmetry plane
/// at half the overlap. In the Hertz limit this is exactly Hertz with 1/E* = 1/E*_s + 1/E*_h for every pair.
struct PairMapping
{
  double e_star;           ///< Pa, E/(1-nu^2) of the yielding body alone
  double sqrt_lambda = 1;  ///< 1 + E*_s/E*_h; 1 for a rigid partner

  static PairMapping rigid_partner(double e_star_yielding) { return {e_star_yielding, 1.0}; }
  static PairMapping deformable_partner(double e_star_yielding, double e_star_partner)
  {
    return {e_star_yielding, 1.0 + e_star_yielding / e_star_partner};
  }

  /// lambda R*: the length that overlaps are divided by, m.
  double length(double r_eff) const { return sqrt_lambda * sqrt_lambda * r_eff; }
  /// 4/3 E*_s lambda R*^2: Hertz's force at an overlap of one length, N.
  double force(double r_eff) const { return 4.0 / 3.0 * e_star * sqrt_lambda * sqrt_lambda * r_eff * r_eff; }
  /// sqrt(lambda) R*: the length that contact radii are divided by, m.
  double radius(double r_eff) const { return sqrt_lambda * r_eff; }
  /// Effective Hertz modulus of the pair, Pa: 1/E* = 1/E*_s + 1/E*_h.
  double e_star_pair() const { return e_star / sqrt_lambda; }
};

/// R* = R_i R_j/(R_i + R_j), m. A plane wall is R_j -> infinity: pass R_i itself.
inline double effective_radius(double radius_i, double radius_j)
{
  return radius_i * radius_j / (radius_i + radius_j);
}

/// m* = m_i m_j/(m_i + m_j), kg.
inline double effective_mass(double mass_i, double mass_j)
{
  return mass_i * mass_j / (mass_i + mass_j);
}

}  // namespace granulaw
