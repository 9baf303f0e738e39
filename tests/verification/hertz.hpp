#pragma once

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

/// Hertz's theory in closed form, for a sphere of radius 1 on a rigid plane, stresses in E* = E/(1-nu^2).
/// Source: K. L. Johnson, Contact Mechanics (1985), sections 3.4 and 4.2.
namespace granulaw::hertz {

/// Contact under a force F (in E* R^2): radius a (in R) and largest pressure p0 (in E*), Johnson (4.22),
/// (4.24).
struct Contact
{
  double a, p0;
};
inline Contact under(double force)
{
  const double a = std::cbrt(0.75 * force);
  return {a, 1.5 * force / (M_PI * a * a)};
}

/// Pressure over p0 at r/a, Johnson (3.39).
inline double pressure(double r_over_a)
{
  return std::sqrt(std::max(0.0, 1 - r_over_a * r_over_a));
}

/// The same on the deformed surface, to first order in p0/E*. Hertz lets the surface move along the normal
/// only; in truth the pressure also draws its points inwards, Johnson (3.41b):
///     u = -(1 - 2 nu)/(3 (1 - nu)) (p0/E*) a (1 - (1 - x^2)^1.5)/x,   x = r0/a < 1,
/// so the force of a ring stands on a smaller area: p (1 + u') (1 + u/r0) = p_Hertz(r0) at r = r0 + u. In the
/// middle this is an excess of (1 - 2 nu)/(1 - nu) p0/E* = (2/pi) (1 - 2 nu)/(1 - nu) a/R.
inline double pressure_on_moved_surface(double r_over_a, double nu, double p0)
{
  const double share = (1 - 2 * nu) / (3 * (1 - nu)) * p0;
  const auto bulge = [](double x) { return x < 1e-4 ? 1.5 * x : (1 - std::pow(1 - x * x, 1.5)) / x; };
  double x = r_over_a;
  for (int k = 0; k < 20; ++k) x = std::min(1.0, r_over_a + share * bulge(x));
  const double hoop = x < 1e-4 ? 1.5 : bulge(x) / x, radial = 3 * std::sqrt(1 - x * x) - hoop;
  return pressure(x) / ((1 - share * radial) * (1 - share * hoop));
}

/// Stresses over p0 on the axis, z/a > 0 below the surface; tension positive, Johnson (3.45).
struct AxisStress
{
  double axial, radial;  ///< hoop = radial
  double von_mises() const { return std::abs(axial - radial); }
};
inline AxisStress on_axis(double z_over_a, double nu)
{
  const double decay = 1 / (1 + z_over_a * z_over_a);
  return {-decay, -(1 + nu) * (1 - z_over_a * std::atan(1 / z_over_a)) + 0.5 * decay};
}

/// Place of the largest von Mises stress on the axis: depth over a, and p0/Y when it reaches Y.
struct Onset
{
  double depth, pressure_ratio;
};
inline Onset onset(double nu)
{
  const auto minus_stress = [nu](double z) { return -on_axis(z, nu).von_mises(); };
  const auto [depth, stress] = boost::math::tools::brent_find_minima(minus_stress, 0.1, 1.0, 40);
  return {depth, -1 / stress};
}

}  // namespace granulaw::hertz
