#pragma once

#include "solver/material/parameter.hpp"

namespace granulaw::flow {

/// Most Newton steps of a search; flow_law_test.cpp shows what is left after them.
inline constexpr int newton_steps = 8;

/// A point's search for the root x of the yield condition at the end of a step of length dt,
///
///     3 G x + J sigma_y(ep + x) g(x/dt) = q,      q > J sigma_y(ep): the trial stress,
///
/// by Newton steps without branches, for loops that vectorise. Flow stress and rate factor may start with an
/// infinite slope, like x^m with m down to 0.05. Hence: start from the least of the three values that x would
/// have if elastic unloading, hardening or rate alone took up the excess (the root lies below each); take u,
/// x = top u^4, as unknown, in which steep starts are flat or nearly straight; keep the root between bounds.
struct Search
{
  double trial, jacobian, ep;  ///< q, J, plastic strain before the step
  double start;                ///< J sigma_y(ep)
  double top = 0.0;            ///< x <= top
  double u = 1.0, low = 0.0, high = 1.0;
  double strain = 0.0;  ///< plastic strain increment x
  double factor = 1.0;  ///< rate factor at the one before
};

template <class Hardening, class Rate>
GRANULAW_INLINE Search begin_search(const Hardening& hardening, const Rate& rate, double trial,
                                    double jacobian, double shear3, double ep, double per_dt)
{
  Search search{trial, jacobian, ep, jacobian * hardening(ep).value};
  const double excess = trial > search.start ? trial - search.start : 0.0;
  double top = excess / shear3;
  const double by_hardening = hardening.strain_at((search.start + excess) / jacobian) - ep;
  top = by_hardening < top ? by_hardening : top;
  const double by_rate = rate.rate_at(excess / search.start) / (per_dt + 1e-150);
  top = by_rate < top ? by_rate : top;
  search.top = search.strain = top > 0.0 ? top : 0.0;
  return search;
}

/// Takes one step; whether it was so short that the next would be none.
template <class Hardening, class Rate>
GRANULAW_INLINE bool newton_step(Search& s, const Hardening& hardening, const Rate& rate, double shear3,
                                 double per_dt)
{
  constexpr double close = 1e-8;  // of x; what is left is its square, by the curvature over x
  const double x = s.strain;
  const ValueAndSlope flow = hardening(s.ep + x), g = rate(x * per_dt);
  const double residual = shear3 * x + s.jacobian * flow.value * g.value - s.trial;
  const double slope = shear3 + s.jacobian * (flow.slope * g.value + flow.value * g.slope * per_dt);
  s.high = residual > 0.0 ? s.u : s.high;
  s.low = residual > 0.0 ? s.low : s.u;
  const double newton = s.u - residual * s.u / (4.0 * x * slope + 1e-300);
  const bool inside = (newton >= s.low) & (newton <= s.high);
  s.u = inside ? newton : 0.5 * (s.low + s.high);
  s.strain = s.top * (s.u * s.u) * (s.u * s.u);
  s.factor = g.value;
  const double moved = s.strain > x ? s.strain - x : x - s.strain;
  return moved <= close * x;
}

struct TangentIncrement
{
  double strain;   ///< plastic strain increment x, 0 below the yield stress
  double stress;   ///< mean of J sigma_y before and after it
  bool converged;  ///< else a search is needed
};

/// The root without rate dependence by three Newton steps, the first from ep. They suffice wherever x is
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
