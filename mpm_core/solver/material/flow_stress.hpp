#pragma once

#include <type_traits>

#include "solver/material/linear.hpp"
#include "solver/material/plastic_increment.hpp"
#include "solver/material/rate_independent.hpp"
#include "solver/material/flow_trials.hpp"

// The flow that brings points back to their flow stress, one scalar equation for each: the part of the stress
// update that depends on hardening and rate, not on the yield surface or dimension. As with the flow laws,
// every function must be always_inline (material/parameter.hpp).

namespace granulaw::flow {

/// A hardening law times a constant.
template <class Hardening>
struct Scaled
{
  Hardening law;
  double by;
  GRANULAW_MEMBER ValueAndSlope operator()(double ep) const
  {
    const ValueAndSlope of = law(ep);
    return {by * of.value, by * of.slope};
  }
  GRANULAW_MEMBER double strain_at(double stress) const { return law.strain_at(stress / by); }
};
template <class Hardening>
GRANULAW_INLINE auto scaled(const Hardening& law, double by)
{
  if constexpr (std::is_same_v<Hardening, Linear>)
    return Linear{by * law.yield, by * law.modulus};
  else
    return Scaled<Hardening>{law, by};
}

/// Points of a block whose yield condition is still open, packed into whole vectors, and their searches.
struct alignas(64) SearchLanes
{
  using Values = double[kernel::block_points];
  Values trial, jacobian, ep, start, top, u, low, high, strain, factor;
};

/// Newton steps on all of them until none moves. A function of its own: both precisions share it.
template <class Hardening, class Rate>
static __attribute__((noinline)) void search_lanes(SearchLanes& l, int lanes, const Hardening hardening,
                                                   const Rate rate, double stiffness, double per_dt)
{
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    const Search s = begin_search(hardening, rate, l.trial[i], l.jacobian[i], stiffness, l.ep[i], per_dt);
    l.start[i] = s.start, l.top[i] = s.top, l.u[i] = s.u, l.low[i] = s.low, l.high[i] = s.high;
    l.strain[i] = s.strain, l.factor[i] = s.factor;
  }
  for (int step = 0; step < newton_steps; ++step) {
    int moving = 0;
#pragma omp simd reduction(+ : moving)
    for (int i = 0; i < lanes; ++i) {
      Search s{l.trial[i], l.jacobian[i], l.ep[i],   l.start[i],  l.top[i],
               l.u[i],     l.low[i],      l.high[i], l.strain[i], l.factor[i]};
      moving += newton_step(s, hardening, rate, stiffness, per_dt) ? 0 : 1;
      l.u[i] = s.u, l.low[i] = s.low, l.high[i] = s.high, l.strain[i] = s.strain, l.factor[i] = s.factor;
    }
    if (moving == 0) break;
  }
}

/// The flow of the points that `open` marks.
template <class Real, class Hardening, class Rate>
GRANULAW_INLINE void search_flow(kernel::FlowTrials<Real>& block, const Real* __restrict trial, int count,
                                 const int (&open)[kernel::block_points],
                                 const Real* __restrict plastic_strain, const Hardening hardening,
                                 const Rate rate, double stiffness, double per_dt)
{
  int point[kernel::block_points + 8], found = 0;
  for (int p = 0; p < count; ++p) {
    point[found] = p;
    found += open[p];
  }
  if (found == 0) return;
  const int lanes = (found + 7) / 8 * 8;  // whole vectors
  for (int i = found; i < lanes; ++i) point[i] = point[found - 1];
  SearchLanes l;
  for (int i = 0; i < lanes; ++i) {
    l.trial[i] = trial[point[i]], l.jacobian[i] = block.jacobian[point[i]];
    l.ep[i] = plastic_strain[point[i]];
  }
  search_lanes(l, lanes, hardening, rate, stiffness, per_dt);
  for (int i = 0; i < found; ++i) {
    block.strain[point[i]] = Real(l.strain[i]);
    block.stress[point[i]] = Real(0.5 * (l.start[i] * l.factor[i] + l.trial[i] - stiffness * l.strain[i]));
  }
}

/// Fills `strain` x and `stress` of each point of a block with the root of
///
///     trial - stiffness x = J sigma_y(ep + x) g(x/dt),      0 where trial <= J sigma_y(ep),
///
/// and the mean of the right side before and after; whether any flows. Perfect and linear hardening in closed
/// form; other laws by Newton steps from the tangent, and where these do not suffice, as at the steep start
/// of a power or with a rate, by a search.
template <class Real, class Hardening, class Rate>
GRANULAW_INLINE bool find_flow(kernel::FlowTrials<Real>& block, const Real* __restrict trial, int count,
                               const Real* __restrict plastic_strain, const Hardening hardening,
                               const Rate rate, double stiffness, double per_dt)
{
  const Real least = Real(hardening(0.0).value);  // no law softens
  int beyond = 0;
#pragma omp simd reduction(+ : beyond)
  for (int p = 0; p < count; ++p) beyond += trial[p] > block.jacobian[p] * least ? 1 : 0;
  if (beyond == 0) return false;

  if constexpr (std::is_same_v<Hardening, Linear> && std::is_same_v<Rate, RateIndependent>) {
    const Real yield = Real(hardening.yield), modulus = Real(hardening.modulus), per = Real(stiffness);
#pragma omp simd
    for (int p = 0; p < count; ++p) {
      const Real jacobian = block.jacobian[p], stress = yield + modulus * plastic_strain[p];
      const Real over = trial[p] - jacobian * stress;
      const Real strain = over > Real(0) ? over / (per + jacobian * modulus) : Real(0);
      block.strain[p] = strain;
      block.stress[p] = jacobian * (stress + Real(0.5) * modulus * strain);
    }
  } else {
    int open[kernel::block_points];
    if constexpr (std::is_same_v<Rate, RateIndependent>) {
#pragma omp simd
      for (int p = 0; p < count; ++p) {
        const TangentIncrement found =
            tangent_increment(hardening, trial[p], block.jacobian[p], stiffness, plastic_strain[p]);
        block.strain[p] = Real(found.strain), block.stress[p] = Real(found.stress);
        open[p] = found.converged ? 0 : 1;
      }
    } else {
#pragma omp simd
      for (int p = 0; p < count; ++p) {
        const double q = trial[p];
        block.strain[p] = Real(0), block.stress[p] = Real(q);
        open[p] = q > block.jacobian[p] * hardening(plastic_strain[p]).value ? 1 : 0;
      }
    }
    search_flow(block, trial, count, open, plastic_strain, hardening, rate, stiffness, per_dt);
  }
  return true;
}

}  // namespace granulaw::flow
