#pragma once

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

/// Hertz's theory in closed form, for a sphere of radius 1 on a rigid plane, stresses in E* = E/(1-nu^2).
/// Source: K. L. Johnson, Contact Mechanics (1985), sections 3.4 and 4.2.
namespace granulaw::hertz {

/// Contact under a force F (in E* R^2): radius a (in R) and largest pressure p0 (in E*), Johnson (4.22), (4.24).
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

/// Where the von Mises stress on the axis is largest: depth over a, and p0/Y when it reaches Y.
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
