#pragma once

#include "law/rising_root.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// Kinetic energy of an impact at sqrt(I) = 1, over 4/3 E* R^3: 1/2 m Y v^2. `mass` over rho R^3, `yield`
/// over E*. That of v is v^2 times it.
inline double energy_unit(double mass, double yield)
{
  return 0.375 * mass * yield;
}

/// Overlap/R at which loading has taken this work, in the unit of the curve's work: that of an impact of so
/// much kinetic energy, if speed changed nothing.
inline double overlap_at_work(const Curve& curve, double work)
{
  constexpr double beyond = 4;  // curves go on past their end
  return rising_root([&](double x) { return curve.work(x) - work; }, 0.0, beyond, 48);
}

}  // namespace granulaw
