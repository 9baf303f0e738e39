#pragma once

#include <cmath>

namespace granulaw {

/// The three scales that make a collision dimensionless; everything else follows from them.
/// The solver works in length R = 1, density rho = 1, stress E* = 1 (docs/theory/method.md: c* = sqrt(E*/rho) = 1).
struct Scales
{
  double length = 1;   ///< m: radius R
  double stress = 1;   ///< Pa: E* = E/(1-nu^2)
  double density = 1;  ///< kg/m^3

  double velocity() const { return std::sqrt(stress / density); }     ///< m/s
  double time() const { return length / velocity(); }                 ///< s
  double force() const { return stress * length * length; }           ///< N
  double energy() const { return force() * length; }                  ///< J
  double mass() const { return density * length * length * length; }  ///< kg
};

/// E* = E/(1-nu^2) of one body, Pa.
inline double plane_strain_modulus(double youngs_modulus, double poisson_ratio)
{
  return youngs_modulus / (1.0 - poisson_ratio * poisson_ratio);
}

/// Customary yield pressure p_y over the yield stress (Thornton 1997). A sphere first yields at 1.6 Y in the middle of
/// its contact; the mean pressure of the fully plastic contact is 2.8 Y.
inline constexpr double customary_yield_pressure = 1.6;

/// Customary yield velocity V_y = (pi/(2E*))^2 sqrt(2/(5 rho)) p_y^2.5 of a sphere on a rigid wall, m/s. A label: the
/// true onset is onset_velocity().
inline double yield_velocity(double e_star, double yield_stress, double density)
{
  const double half_pi_over_e = M_PI / (2.0 * e_star);
  return half_pi_over_e * half_pi_over_e * std::sqrt(2.0 / (5.0 * density)) *
         std::pow(customary_yield_pressure * yield_stress, 2.5);
}

/// C(nu): the Hertz peak pressure, in units of Y, at which J2 yield begins below the surface.
/// Fit 1.295 exp(0.736 nu) through 1.299, 1.499, 1.613, 1.806 at nu = 0, .2, .3, .45 (K. L. Johnson,
/// Contact Mechanics, sect. 6.1; Jackson and Green 2005).
inline double onset_pressure_ratio(double poisson_ratio)
{
  return 1.295 * std::exp(0.736 * poisson_ratio);
}

/// Overlap/R at the true onset of yield on a rigid wall: (pi C Y/(2 E*))^2.
inline double onset_overlap(double e_star, double yield_stress, double poisson_ratio)
{
  const double q = M_PI * onset_pressure_ratio(poisson_ratio) * yield_stress / (2.0 * e_star);
  return q * q;
}

/// Impact velocity at the true onset of yield, m/s: V_y with C(nu) Y in place of p_y.
inline double onset_velocity(double e_star, double yield_stress, double density, double poisson_ratio)
{
  return yield_velocity(e_star, yield_stress, density) *
         std::pow(onset_pressure_ratio(poisson_ratio) / customary_yield_pressure, 2.5);
}

}  // namespace granulaw
