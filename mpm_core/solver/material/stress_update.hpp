#pragma once

#include "solver/material/cauchy_stress.hpp"
#include "solver/material/kernel_math.hpp"
#include "solver/material/yielding.hpp"

// The stress update of material points, the same in all dimensions: multiplicative plasticity with
// logarithmic elastic strain. Trial b = F Cp^-1 F^T, its logarithmic strain, the flow that the yield function
// finds for it, first Piola-Kirchhoff stress P = tau F^-T. Yield is on the Cauchy stress tau/J. All tensors
// are kept as difference from the identity. As with the flow laws, every function must be static or
// always_inline (material/parameter.hpp).
//
// A dimension is a Tensor: axisymmetric_tensor.hpp, spatial_tensor.hpp.

namespace granulaw::kernel {

/// State of the points of one block, from its first.
template <class Tensor>
struct BlockState
{
  using Real = typename Tensor::Number;
  Real* __restrict c[Tensor::components];  ///< inverse plastic right Cauchy-Green tensor minus identity
  Real* __restrict plastic_strain;
  Real* __restrict plastic_work;
  Real* __restrict energy;
  const Real* __restrict volume;
};

/// Points of one block with all plastic flow of the step undone, and their flow.
template <class Tensor>
struct alignas(64) Trials
{
  using Real = typename Tensor::Number;
  Real strain[Tensor::kept][block_points];
  FlowTrials<Real> flow;
};

template <bool has_state, bool yields, class Tensor, class Real>
GRANULAW_INLINE void trial_point(const typename Tensor::Block& block, const BlockState<Tensor>& state, int p,
                                 Real shear2, Trials<Tensor>& out)
{
  const typename Tensor::Gradient h = Tensor::gradient(block, p);
  typename Tensor::Symmetric x = Tensor::stretched(h);
  if constexpr (has_state) Tensor::add_pushed(x, h, Tensor::state(state.c, p));
  const typename Tensor::Strain e = Tensor::logarithm(x);
  Tensor::template put<yields>(out.strain, p, x, e);
  out.flow.trace[p] = e.trace;
  if constexpr (yields) {
    out.flow.q[p] = shear2 * root_of(Real(1.5) * Tensor::square(e));
    out.flow.jacobian[p] = Tensor::determinant(h);
  }
}

/// The point after its flow: plastic state, stored energy, stress.
template <bool flows, bool dilates, class Tensor, class Real>
GRANULAW_INLINE void finish_point(typename Tensor::Block& block, const BlockState<Tensor>& state, int p,
                                  const Trials<Tensor>& trials, Real shear2, Real bulk)
{
  const typename Tensor::Gradient h = Tensor::gradient(block, p);
  Real trace = trials.flow.trace[p];
  const Real volume = state.volume[p];
  typename Tensor::Strain e = Tensor::strain(trials.strain, p, trace);
  if constexpr (flows) {
    const Real flow = trials.flow.strain[p];
    const Real share = Real(1.5) * shear2 * flow / (trials.flow.q[p] + tiny<Real>);
    const Real dilation = dilates ? trials.flow.dilation[p] : Real(0);
    Tensor::template add_pulled_back_flow<dilates>(state.c, p, trials.strain, h, e, Real(-2) * share,
                                                   Real(-2.0 / 3.0) * dilation);
    state.plastic_strain[p] += flow;
    state.plastic_work[p] += volume * trials.flow.stress[p] * flow;
    Tensor::shrink(e, share);
    if constexpr (dilates) {
      trace -= dilation;
      state.plastic_work[p] += volume * bulk * trace * dilation;
    }
  }
  const Real pressure = bulk * trace;
  state.energy[p] = volume * Real(0.5) * (shear2 * Tensor::square(e) + bulk * trace * trace);
  Tensor::put_stress(block, p, h, e, shear2, pressure, volume);
}

template <bool has_state, bool yields, class Tensor, class Real>
static __attribute__((noinline)) void find_trials(const typename Tensor::Block& block,
                                                  const BlockState<Tensor> state, int count, Real shear2,
                                                  Trials<Tensor>& trials)
{
#pragma omp simd
  for (int p = 0; p < count; ++p) trial_point<has_state, yields>(block, state, p, shear2, trials);
}

template <bool flows, bool dilates, class Tensor, class Real>
static __attribute__((noinline)) void finish(typename Tensor::Block& block, const BlockState<Tensor> state,
                                             int count, const Trials<Tensor>& trials, Real shear2, Real bulk)
{
#pragma omp simd
  for (int p = 0; p < count; ++p) finish_point<flows, dilates>(block, state, p, trials, shear2, bulk);
}

/// Cauchy stress of points whose plastic state is that of their displacement gradients.
template <class Tensor>
static void cauchy_stress(const BlockState<Tensor> state, const Moduli& moduli, int count,
                          const typename Tensor::Block& block, CauchyStress* points)
{
  for (int p = 0; p < count; ++p) {
    const typename Tensor::Gradient h = Tensor::gradient(block, p);
    typename Tensor::Symmetric x = Tensor::stretched(h);
    Tensor::add_pushed(x, h, Tensor::state(state.c, p));
    const typename Tensor::Strain e = Tensor::logarithm(x);
    points[p] = Tensor::cauchy_stress(h, e, 2.0 * moduli.shear, moduli.bulk * e.trace);
  }
}

/// Flow of a region: of its material; frozen and on the `updated` grid the plastic state of a body that does
/// not flow counts, too.
template <class Real>
GRANULAW_INLINE Yielding<Real> yielding_of(const Moduli& moduli)
{
  if constexpr (std::is_same_v<Real, float>)
    return GRANULAW_ISA_NAMESPACE::yielding_in_float(moduli);
  else
    return GRANULAW_ISA_NAMESPACE::yielding_in_double(moduli);
}

/// Stress and state of `count` points from their displacement gradients. `per_dt`: 1 over the time since the
/// last update, 0: rate-independent. `since_last`: the gradients are those of the last step (`updated`), and
/// J is that of the elastic strain.
template <class Tensor, class Real = typename Tensor::Number>
static void update_stress(const BlockState<Tensor> state, const Moduli& moduli,
                          const Yielding<Real>& yielding, double per_dt, bool since_last, int count,
                          typename Tensor::Block& block)
{
  const Real shear2 = Real(2.0 * moduli.shear), bulk = Real(moduli.bulk);
  Trials<Tensor> trials;
  bool flows = false;
  if (yielding.find) {
    find_trials<true, true>(block, state, count, shear2, trials);
    if (since_last)
      for (int p = 0; p < count; ++p) trials.flow.jacobian[p] = Real(1) + exp_m1(trials.flow.trace[p]);
    flows = yielding.find(trials.flow, count, state.plastic_strain, moduli, yielding.flow_stress, per_dt);
  } else if (yielding.has_state)
    find_trials<true, false>(block, state, count, shear2, trials);
  else
    find_trials<false, false>(block, state, count, shear2, trials);
  if (!flows)
    finish<false, false>(block, state, count, trials, shear2, bulk);
  else if (yielding.dilates)
    finish<true, true>(block, state, count, trials, shear2, bulk);
  else
    finish<true, false>(block, state, count, trials, shear2, bulk);
}

}  // namespace granulaw::kernel
