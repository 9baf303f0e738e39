#pragma once

#include <type_traits>

#include "solver/flow/laws.hpp"
#include "solver/flow/plastic_increment.hpp"
#include "solver/moduli.hpp"

// What the material points of a block flow in a step: the part of the stress update that asks for the laws
// and not for the dimension. Shared by all kernels; as with the flow laws, every function must be
// always_inline (flow/parts.hpp). `Trials` has arrays q, jacobian (in) and strain, stress (out), one entry a
// point: von Mises' equivalent of the trial Kirchhoff stress, J, the plastic strain increment, and the mean
// Kirchhoff stress meanwhile.

namespace granulaw::kernel {

constexpr int block_points = 64;

/// Hardening "laws" of a body that does not yield: with nothing to remember, and with the elastic strain that
/// an `updated` grid keeps.
struct Elastic
{
};
struct ElasticWithState
{
};

/// Which points of a block flow and are yet to be searched, closed up: their increments by Newton steps side
/// by side until none moves any more.
template <class Trials, class Real, class Hardening, class Rate>
GRANULAW_INLINE void search_flow(Trials& block, int count, const int (&open)[block_points],
                                 const Real* __restrict plastic_strain, const Hardening hardening,
                                 const Rate rate, double shear3, double per_dt)
{
  int point[block_points + 8], found = 0;
  for (int p = 0; p < count; ++p) {
    point[found] = p;
    found += open[p];
  }
  if (found == 0) return;
  const int lanes = (found + 7) / 8 * 8;  // whole vectors
  for (int i = found; i < lanes; ++i) point[i] = point[found - 1];

  alignas(64) double trial[block_points], jacobian[block_points], ep[block_points], start[block_points],
      top[block_points], u[block_points], low[block_points], high[block_points], strain[block_points],
      factor[block_points];
  for (int i = 0; i < lanes; ++i) {
    trial[i] = block.q[point[i]], jacobian[i] = block.jacobian[point[i]];
    ep[i] = plastic_strain[point[i]];
  }
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    const flow::Search s = flow::begin_search(hardening, rate, trial[i], jacobian[i], shear3, ep[i], per_dt);
    start[i] = s.start, top[i] = s.top, u[i] = s.u, low[i] = s.low, high[i] = s.high;
    strain[i] = s.strain, factor[i] = s.factor;
  }
  for (int step = 0; step < flow::newton_steps; ++step) {
    int moving = 0;
#pragma omp simd reduction(+ : moving)
    for (int i = 0; i < lanes; ++i) {
      flow::Search s{trial[i], jacobian[i], ep[i],   start[i],  top[i],
                     u[i],     low[i],      high[i], strain[i], factor[i]};
      moving += flow::newton_step(s, hardening, rate, shear3, per_dt) ? 0 : 1;
      u[i] = s.u, low[i] = s.low, high[i] = s.high, strain[i] = s.strain, factor[i] = s.factor;
    }
    if (moving == 0) break;
  }
  for (int i = 0; i < found; ++i) {
    block.strain[point[i]] = Real(strain[i]);
    block.stress[point[i]] = Real(0.5 * (start[i] * factor[i] + trial[i] - shear3 * strain[i]));
  }
}

/// Finds what the points of a block flow; whether any does. Perfect and linear hardening in closed form;
/// other laws by Newton steps from the tangent, and where these do not suffice, as at the steep start of a
/// power or with a rate, by a search.
template <class Trials, class Real, class Hardening, class Rate>
GRANULAW_INLINE bool find_flow(Trials& block, int count, const Real* __restrict plastic_strain,
                               const Hardening hardening, const Rate rate, const Moduli& moduli,
                               double per_dt)
{
  const Real least = Real(hardening(0.0).value);  // no law softens
  int beyond = 0;
#pragma omp simd reduction(+ : beyond)
  for (int p = 0; p < count; ++p) beyond += block.q[p] > block.jacobian[p] * least ? 1 : 0;
  if (beyond == 0) return false;

  const double shear3 = 3.0 * moduli.shear;
  if constexpr (std::is_same_v<Hardening, flow::Linear> && std::is_same_v<Rate, flow::RateIndependent>) {
    // q - 3 G dg = J (sigma_y + H dg)
    const Real yield = Real(moduli.yield), modulus = Real(moduli.hardening), stiffness = Real(shear3);
#pragma omp simd
    for (int p = 0; p < count; ++p) {
      const Real jacobian = block.jacobian[p], stress = yield + modulus * plastic_strain[p];
      const Real over = block.q[p] - jacobian * stress;
      const Real strain = over > Real(0) ? over / (stiffness + jacobian * modulus) : Real(0);
      block.strain[p] = strain;
      block.stress[p] = jacobian * (stress + Real(0.5) * modulus * strain);
    }
  } else {
    int open[block_points];
    if constexpr (std::is_same_v<Rate, flow::RateIndependent>) {
#pragma omp simd
      for (int p = 0; p < count; ++p) {
        const flow::TangentIncrement found =
            flow::tangent_increment(hardening, block.q[p], block.jacobian[p], shear3, plastic_strain[p]);
        block.strain[p] = Real(found.strain), block.stress[p] = Real(found.stress);
        open[p] = found.converged ? 0 : 1;
      }
    } else {
#pragma omp simd
      for (int p = 0; p < count; ++p) {
        const double q = block.q[p];
        block.strain[p] = Real(0), block.stress[p] = Real(q);
        open[p] = q > block.jacobian[p] * hardening(plastic_strain[p]).value ? 1 : 0;
      }
    }
    search_flow(block, count, open, plastic_strain, hardening, rate, shear3, per_dt);
  }
  return true;
}

constexpr flow::RateIndependent no_rate{};

template <class Rate, class Use, class... Hardening>
GRANULAW_INLINE void with_hardening(const Moduli& moduli, Use use, flow::LawList<Hardening...>)
{
  int k = 0;
  ((k++ == moduli.flow.hardening ? use(Hardening::from(moduli.yield, moduli.flow.hardening_values),
                                       Rate::from(moduli.flow.rate_values))
                                 : void()),
   ...);
}

template <class Use, class... Rate>
GRANULAW_INLINE void with_rate(const Moduli& moduli, Use use, flow::LawList<Rate...>)
{
  int k = 0;
  ((k++ == moduli.flow.rate ? with_hardening<Rate>(moduli, use, flow::HardeningLaws{}) : void()), ...);
}

/// Calls use(hardening, rate) with the laws of a material that yields.
template <class Use>
GRANULAW_INLINE void with_flow_laws(const Moduli& moduli, Use use)
{
  with_rate(moduli, use, flow::RateLaws{});
}

}  // namespace granulaw::kernel
