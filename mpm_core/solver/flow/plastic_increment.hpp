#pragma once

#include "solver/flow/parts.hpp"

namespace granulaw::flow {

/// Rate factor of a material that does not depend on the rate.
struct RateIndependent
{
  static constexpr const char* name = "none";
  static constexpr Parameter parameters[] = {{"", Quantity::number, 0, 0}};
  static GRANULAW_MEMBER RateIndependent from(const double*) { return {}; }
  GRANULAW_MEMBER ValueAndSlope operator()(double) const { return {1.0, 0.0}; }
  /// The rate at which the factor is 1 + excess; any large number if that is of no help.
  GRANULAW_MEMBER double rate_at(double) const { return unreached; }
};

struct PlasticIncrement
{
  double strain;  ///< plastic strain increment x
  double factor;  ///< rate factor at the end of the increment
};

/// Newton steps of plastic_increment; flow_law_test.cpp shows what is left after them.
inline constexpr int newton_steps = 8;

/// The root x of the yield condition at the end of a step of length dt,
///
///     3 G x + J sigma_y(ep + x) g(x/dt) = q,      q > J sigma_y(ep): the trial stress,
///
/// by a fixed number of Newton steps, for loops that vectorise. Flow stress and rate factor may start with an
/// infinite slope, like x^m with m down to 0.05. Hence: start from the least of the three values that x would
/// have if elastic unloading, hardening or rate alone took up the excess (the root lies below each); take u,
/// x = top u^4, as unknown, in which steep starts are flat or nearly straight; keep the root between bounds.
template <class Hardening, class Rate>
GRANULAW_INLINE PlasticIncrement plastic_increment(const Hardening& hardening, const Rate& rate, double trial,
                                                   double jacobian, double shear3, double ep, double per_dt)
{
  const double start = jacobian * hardening(ep).value;
  const double excess = trial > start ? trial - start : 0.0;
  double top = excess / shear3;
  const double by_hardening = hardening.strain_at((start + excess) / jacobian) - ep;
  top = by_hardening < top ? by_hardening : top;
  const double by_rate = rate.rate_at(excess / start) / (per_dt + 1e-150);
  top = by_rate < top ? by_rate : top;
  top = top > 0.0 ? top : 0.0;

  double u = 1.0, low = 0.0, high = 1.0, x = top, factor = 1.0;
#pragma GCC unroll 16
  for (int k = 0; k < newton_steps; ++k) {
    const ValueAndSlope s = hardening(ep + x), g = rate(x * per_dt);
    const double residual = shear3 * x + jacobian * s.value * g.value - trial;
    const double slope = shear3 + jacobian * (s.slope * g.value + s.value * g.slope * per_dt);
    high = residual > 0.0 ? u : high;
    low = residual > 0.0 ? low : u;
    const double newton = u - residual * u / (4.0 * x * slope + 1e-300);
    const bool inside = (newton >= low) & (newton <= high);
    u = inside ? newton : 0.5 * (low + high);
    x = top * (u * u) * (u * u);
    factor = g.value;
  }
  return {x, factor};
}

struct TangentIncrement
{
  double strain;   ///< plastic strain increment x, 0 below the yield stress
  double stress;   ///< mean of J sigma_y before and after it
  bool converged;  ///< else plastic_increment is needed
};

/// The same without rate dependence by three Newton steps, the first from ep. They suffice wherever x is
/// small beside the strain over which the slope changes: everywhere but near the start of a steep law.
template <class Hardening>
GRANULAW_INLINE TangentIncrement tangent_increment(const Hardening& hardening, double trial, double jacobian,
                                                   double shear3, double ep)
{
  constexpr double close = 1e-6;  // last step over x; what is left is its square over the one before
  const ValueAndSlope first = hardening(ep);
  const double start = jacobian * first.value;
  const double excess = trial > start ? trial - start : 0.0;
  double x = excess / (shear3 + jacobian * first.slope), step = 0.0;
#pragma GCC unroll 2
  for (int k = 0; k < 2; ++k) {
    const ValueAndSlope s = hardening(ep + x);
    const double missing = start + excess - shear3 * x - jacobian * s.value;
    step = missing / (shear3 + jacobian * s.slope);
    step = excess > 0.0 ? step : 0.0;
    x += step;
  }
  const double size = step < 0.0 ? -step : step;
  return {x, 0.5 * (start + (start + excess - shear3 * x)), size <= close * x};
}

}  // namespace granulaw::flow
