// Compiled once for each instruction set (CMakeLists.txt), with GRANULAW_ISA_NAMESPACE and GRANULAW_ISA_NAME
// set. Nothing here may come from a shared inline function: the linker would pick one copy for all sets.
// Hence raw pointers and compiler built-ins only.
//
// A force evaluation goes block by block through each region of the body, in three stages that know nothing
// of each other: gather (grid: displacement gradients), stress (material), corner_forces (grid).
#include <type_traits>

#include "solver/kernel_flow.hpp"
#include "solver/kernel_math.hpp"
#include "solver/kernels.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

using namespace kernel;

/// What the stages hand on for the points of one block.
template <class Real>
struct alignas(64) Block
{
  using Values = Real[block_points];
  Values hrr, hrz, hzr, hzz, hhh;  ///< displacement gradient, F = 1 + h
  Values prr, prz, pzr, pzz, phh;  ///< first Piola-Kirchhoff stress
  Values qr, qz;                   ///< four corners: hourglass amplitudes
};

template <class Real>
GRANULAW_INLINE PointArrays<Real>& arrays(Body& body)
{
  if constexpr (std::is_same_v<Real, float>)
    return body.single;
  else
    return body;
}

/// Displacement gradients of `count` points from the `corners` nodes of each. Differences to the first node
/// are taken in double, so that float loses nothing to a common displacement.
template <int corners, class Real>
__attribute__((noinline)) void gather(Body& body, int first, int count, Block<Real>& out)
{
  const PointArrays<Real>& points = arrays<Real>(body);
  const int n = body.points;
  const int* __restrict corner = body.corner_p.data() + first;
  const Real* __restrict br = points.br_p.data() + first;
  const Real* __restrict bz = points.bz_p.data() + first;
  const Real* __restrict bh = points.bh_p.data() + first;
  const Real* __restrict gamma = corners == 4 ? points.hourglass_p.data() + first : nullptr;
  const double* __restrict ur = body.ur_i.data();
  const double* __restrict uz = body.uz_i.data();
#pragma omp simd
  for (int p = 0; p < count; ++p) {
    const double from_r = ur[corner[p]], from_z = uz[corner[p]];
    Real hrr = 0, hrz = 0, hzr = 0, hzz = 0, hhh = 0, qr = 0, qz = 0;
#pragma GCC unroll 16
    for (int k = 0; k < corners; ++k) {
      const int at = k * n + p, i = corner[at];
      const Real r = Real(ur[i] - from_r), z = Real(uz[i] - from_z);
      hrr += br[at] * r, hrz += bz[at] * r;
      hzr += br[at] * z, hzz += bz[at] * z;
      hhh += bh[at] * Real(ur[i]);
      if constexpr (corners == 4) qr += gamma[at] * r, qz += gamma[at] * z;
    }
    out.hrr[p] = hrr, out.hrz[p] = hrz, out.hzr[p] = hzr, out.hzz[p] = hzz, out.hhh[p] = hhh;
    if constexpr (corners == 4) out.qr[p] = qr, out.qz[p] = qz;
  }
}

/// Forces on the corners of each point: minus stress times weights, and the hourglass control in total form,
/// which acts on the non-linear part of the displacement only.
template <int corners, class Real>
__attribute__((noinline)) void corner_forces(Body& body, int first, int count, const Block<Real>& in)
{
  PointArrays<Real>& points = arrays<Real>(body);
  const int n = body.points;
  const Real* __restrict br = points.br_p.data() + first;
  const Real* __restrict bz = points.bz_p.data() + first;
  const Real* __restrict bh = points.bh_p.data() + first;
  const Real* __restrict gamma = corners == 4 ? points.hourglass_p.data() + first : nullptr;
  const Real* __restrict stiffness = corners == 4 ? points.stiffness_p.data() + first : nullptr;
  const Real* __restrict volume = points.volume_p.data() + first;
  Real* __restrict energy = points.elastic_energy_p.data() + first;
  Real* __restrict corner_fr = points.corner_fr.data() + first;
  Real* __restrict corner_fz = points.corner_fz.data() + first;
#pragma omp simd
  for (int p = 0; p < count; ++p) {
    const Real v = volume[p];
    const Real prr = v * in.prr[p], prz = v * in.prz[p], pzr = v * in.pzr[p], pzz = v * in.pzz[p];
    const Real phh = v * in.phh[p];
    Real kr = 0, kz = 0;
    if constexpr (corners == 4) {
      kr = stiffness[p] * in.qr[p], kz = stiffness[p] * in.qz[p];
      energy[p] += Real(0.5) * (kr * in.qr[p] + kz * in.qz[p]);
    }
#pragma GCC unroll 16
    for (int k = 0; k < corners; ++k) {
      const int at = k * n + p;
      Real fr = -(prr * br[at] + prz * bz[at] + phh * bh[at]);
      Real fz = -(pzr * br[at] + pzz * bz[at]);
      if constexpr (corners == 4) fr -= kr * gamma[at], fz -= kz * gamma[at];
      corner_fr[at] = fr, corner_fz[at] = fz;
    }
  }
}

/// State of the points of one block, from its first.
template <class Real>
struct PointState
{
  Real* __restrict rr;  ///< of the plastic state as PointArrays keeps it
  Real* __restrict zz;
  Real* __restrict rz;
  Real* __restrict hh;
  Real* __restrict plastic_strain;
  Real* __restrict plastic_work;
  Real* __restrict energy;
  const Real* __restrict volume;

  GRANULAW_MEMBER PointState(PointArrays<Real>& points, int first)
      : rr(points.crr_p.data() + first),
        zz(points.czz_p.data() + first),
        rz(points.crz_p.data() + first),
        hh(points.chh_p.data() + first),
        plastic_strain(points.plastic_strain_p.data() + first),
        plastic_work(points.plastic_work_p.data() + first),
        energy(points.elastic_energy_p.data() + first),
        volume(points.volume_p.data() + first)
  {
  }
};

/// Of one point: the state with all plastic flow of the step undone.
template <class Real>
struct Trial
{
  Real x1, x2, xhh;   ///< principal values of the elastic left Cauchy-Green tensor minus identity
  Real cosine, sine;  ///< of twice the angle of its principal axes
  Real s1, s2, s3;    ///< deviators of the principal logarithmic strains
  Real trace;         ///< and their sum, ln J
  Real q, jacobian;   ///< bodies that yield: von Mises' equivalent of the Kirchhoff stress; J
};

/// What the points of a block flow in a step: equivalent plastic strain, and the Kirchhoff stress meanwhile.
template <class Real>
struct PlasticFlow
{
  Real strain, stress;
};

/// Both of a block.
template <class Real>
struct alignas(64) Trials
{
  using Values = Real[block_points];
  Values x1, x2, xhh, cosine, sine, s1, s2, s3, trace, q, jacobian;
  Values strain, stress;

  GRANULAW_MEMBER void put(int p, const Trial<Real> t)
  {
    x1[p] = t.x1, x2[p] = t.x2, xhh[p] = t.xhh, cosine[p] = t.cosine, sine[p] = t.sine;
    s1[p] = t.s1, s2[p] = t.s2, s3[p] = t.s3, trace[p] = t.trace, q[p] = t.q, jacobian[p] = t.jacobian;
  }
  GRANULAW_MEMBER Trial<Real> trial(int p) const
  {
    return {x1[p], x2[p], xhh[p], cosine[p], sine[p], s1[p], s2[p], s3[p], trace[p], q[p], jacobian[p]};
  }
  GRANULAW_MEMBER PlasticFlow<Real> flow(int p) const { return {strain[p], stress[p]}; }
};

/// Trial state of a point from its displacement gradient and the plastic state `c` before the step.
template <bool has_state, bool yields, class Real>
GRANULAW_INLINE Trial<Real> trial_state(const Block<Real>& block, const PointState<Real>& c, int p,
                                        Real shear2)
{
  constexpr Real one = 1, tiny = std::is_same_v<Real, float> ? Real(1e-37) : Real(1e-300);
  const Real hrr = block.hrr[p], hrz = block.hrz[p], hzr = block.hzr[p], hzz = block.hzz[p],
             hhh = block.hhh[p];
  const Real frr = one + hrr, fzz = one + hzz, fhh = one + hhh;
  Real xrr = Real(2) * hrr + hrr * hrr + hrz * hrz;
  Real xzz = Real(2) * hzz + hzz * hzz + hzr * hzr;
  Real xrz = hrz + hzr + hrr * hzr + hrz * hzz;
  Trial<Real> t;
  t.xhh = Real(2) * hhh + hhh * hhh;
  if constexpr (has_state) {
    const Real c11 = c.rr[p], c22 = c.zz[p], c12 = c.rz[p];
    const Real g11 = frr * c11 + hrz * c12, g12 = frr * c12 + hrz * c22;
    const Real g21 = hzr * c11 + fzz * c12, g22 = hzr * c12 + fzz * c22;
    xrr += g11 * frr + g12 * hrz;
    xrz += g11 * hzr + g12 * fzz;
    xzz += g21 * hzr + g22 * fzz;
    t.xhh += fhh * fhh * c.hh[p];
  }
  const Real mean = Real(0.5) * (xrr + xzz), half = Real(0.5) * (xrr - xzz);
  const Real radius = root_of(half * half + xrz * xrz);
  const Real per_radius = one / (radius + tiny);
  t.cosine = half * per_radius, t.sine = xrz * per_radius;
  t.x1 = mean + radius, t.x2 = mean - radius;
  const Real e1 = Real(0.5) * log_1p(t.x1), e2 = Real(0.5) * log_1p(t.x2), e3 = Real(0.5) * log_1p(t.xhh);
  t.trace = e1 + e2 + e3;
  const Real third = t.trace * Real(1.0 / 3.0);
  t.s1 = e1 - third, t.s2 = e2 - third, t.s3 = e3 - third;
  t.q = 0, t.jacobian = 1;
  if constexpr (yields) {
    t.q = shear2 * root_of(Real(1.5) * (t.s1 * t.s1 + t.s2 * t.s2 + t.s3 * t.s3));
    t.jacobian = one + exp_m1(t.trace);
  }
  return t;
}

/// The point after its flow: plastic state, stored energy, first Piola-Kirchhoff stress.
template <bool flows, class Real>
GRANULAW_INLINE void finish_point(Block<Real>& block, const PointState<Real>& c, int p, Trial<Real> t,
                                  const PlasticFlow<Real> flow, Real shear2, Real bulk)
{
  constexpr Real one = 1, tiny = std::is_same_v<Real, float> ? Real(1e-37) : Real(1e-300);
  const Real hrr = block.hrr[p], hrz = block.hrz[p], hzr = block.hzr[p], hzz = block.hzz[p],
             hhh = block.hhh[p];
  const Real frr = one + hrr, fzz = one + hzz, fhh = one + hhh;
  const Real det = frr * fzz - hrz * hzr;
  const Real per_det = one / det, per_fhh = one / fhh;
  if constexpr (flows) {
    const Real shrink = Real(1.5) * shear2 * flow.strain / (t.q + tiny);
    // plastic state: b_new - b_trial carried back through F
    const Real d1 = (one + t.x1) * exp_m1(Real(-2) * shrink * t.s1);
    const Real d2 = (one + t.x2) * exp_m1(Real(-2) * shrink * t.s2);
    const Real d3 = (one + t.xhh) * exp_m1(Real(-2) * shrink * t.s3);
    const Real dm = Real(0.5) * (d1 + d2), dd = Real(0.5) * (d1 - d2);
    const Real drr = dm + dd * t.cosine, dzz = dm - dd * t.cosine, drz = dd * t.sine;
    const Real g11 = fzz * drr - hrz * drz, g12 = fzz * drz - hrz * dzz;
    const Real g21 = -hzr * drr + frr * drz, g22 = -hzr * drz + frr * dzz;
    const Real per_det2 = per_det * per_det;
    c.rr[p] += per_det2 * (g11 * fzz - g12 * hrz);
    c.rz[p] += per_det2 * (-g11 * hzr + g12 * frr);
    c.zz[p] += per_det2 * (-g21 * hzr + g22 * frr);
    c.hh[p] += per_fhh * per_fhh * d3;
    c.plastic_strain[p] += flow.strain;
    c.plastic_work[p] += c.volume[p] * flow.stress * flow.strain;
    t.s1 -= shrink * t.s1, t.s2 -= shrink * t.s2, t.s3 -= shrink * t.s3;
  }
  // Kirchhoff stress, then P = tau F^-T
  const Real pressure = bulk * t.trace;
  const Real t1 = shear2 * t.s1 + pressure, t2 = shear2 * t.s2 + pressure, t3 = shear2 * t.s3 + pressure;
  const Real tm = Real(0.5) * (t1 + t2), td = Real(0.5) * (t1 - t2);
  const Real trr = tm + td * t.cosine, tzz = tm - td * t.cosine, trz = td * t.sine;
  block.prr[p] = (trr * fzz - trz * hrz) * per_det, block.prz[p] = (trz * frr - trr * hzr) * per_det;
  block.pzr[p] = (trz * fzz - tzz * hrz) * per_det, block.pzz[p] = (tzz * frr - trz * hzr) * per_det;
  block.phh[p] = t3 * per_fhh;
  c.energy[p] = c.volume[p] * Real(0.5) *
                (shear2 * (t.s1 * t.s1 + t.s2 * t.s2 + t.s3 * t.s3) + bulk * t.trace * t.trace);
}

/// Stress update of the points of one block.
///
/// Multiplicative J2 plasticity with logarithmic elastic strain: trial b = F Cp^-1 F^T, its principal
/// logarithmic strains, radial return, first Piola-Kirchhoff stress P = tau F^-T. Yield is on the Cauchy
/// stress sigma = tau/J: q(tau) <= J sigma_y, with J from the trace (plastic flow keeps the volume).
/// Everything is kept as difference from the identity.
template <class Real, class Hardening, class Rate>
GRANULAW_INLINE void stress(Body& body, const Moduli& moduli, int first, int count, Block<Real>& block,
                            [[maybe_unused]] const Hardening hardening_law,
                            [[maybe_unused]] const Rate rate_law)
{
  constexpr bool has_state = !std::is_same_v<Hardening, Elastic>;
  constexpr bool yields = has_state && !std::is_same_v<Hardening, ElasticWithState>;
  const Real shear2 = Real(2.0 * moduli.shear), bulk = Real(moduli.bulk);
  const PointState<Real> state(arrays<Real>(body), first);

  Trials<Real> trials;
#pragma omp simd
  for (int p = 0; p < count; ++p) trials.put(p, trial_state<has_state, yields>(block, state, p, shear2));
  bool flows = false;
  if constexpr (yields)
    flows = find_flow(trials, count, state.plastic_strain, hardening_law, rate_law, moduli,
                      body.elapsed > 0.0 ? 1.0 / body.elapsed : 0.0);
  if (yields && flows) {
#pragma omp simd
    for (int p = 0; p < count; ++p)
      finish_point<true>(block, state, p, trials.trial(p), trials.flow(p), shear2, bulk);
  } else {
#pragma omp simd
    for (int p = 0; p < count; ++p)
      finish_point<false>(block, state, p, trials.trial(p), PlasticFlow<Real>{}, shear2, bulk);
  }
}

/// `updated` grid: what the stages found for the displacements of one step becomes the points' own: elastic
/// left Cauchy-Green tensor and Kirchhoff stress after the step, both pushed forward through it.
__attribute__((noinline)) void push_forward(Body& body, int first, int count, const Block<double>& block)
{
  MovingPoints& m = *body.moving;
  double* __restrict crr = body.crr_p.data() + first;
  double* __restrict czz = body.czz_p.data() + first;
  double* __restrict crz = body.crz_p.data() + first;
  double* __restrict chh = body.chh_p.data() + first;
  double* __restrict trr = m.trr.data() + first;
  double* __restrict tzz = m.tzz.data() + first;
  double* __restrict trz = m.trz.data() + first;
  double* __restrict thh = m.thh.data() + first;
#pragma omp simd
  for (int p = 0; p < count; ++p) {
    const double hrr = block.hrr[p], hrz = block.hrz[p], hzr = block.hzr[p], hzz = block.hzz[p];
    const double hhh = block.hhh[p], frr = 1.0 + hrr, fzz = 1.0 + hzz, fhh = 1.0 + hhh;
    const double c11 = crr[p], c22 = czz[p], c12 = crz[p];
    const double g11 = frr * c11 + hrz * c12, g12 = frr * c12 + hrz * c22;
    const double g21 = hzr * c11 + fzz * c12, g22 = hzr * c12 + fzz * c22;
    crr[p] = 2.0 * hrr + hrr * hrr + hrz * hrz + g11 * frr + g12 * hrz;
    crz[p] = hrz + hzr + hrr * hzr + hrz * hzz + g11 * hzr + g12 * fzz;
    czz[p] = 2.0 * hzz + hzz * hzz + hzr * hzr + g21 * hzr + g22 * fzz;
    chh[p] = 2.0 * hhh + hhh * hhh + fhh * fhh * chh[p];
    trr[p] = block.prr[p] * frr + block.prz[p] * hrz;
    trz[p] = block.prr[p] * hzr + block.prz[p] * fzz;
    tzz[p] = block.pzr[p] * hzr + block.pzz[p] * fzz;
    thh[p] = block.phh[p] * fhh;
  }
}

template <class Real>
GRANULAW_INLINE void sum_to_nodes(Body& body)
{
  const PointArrays<Real>& points = arrays<Real>(body);
  const int nodes = body.nodes, slots = body.slots;
  const int* __restrict slot = body.node_slots.data();
  const Real* __restrict corner_fr = points.corner_fr.data();
  const Real* __restrict corner_fz = points.corner_fz.data();
  double* __restrict fr = body.fr_i.data();
  double* __restrict fz = body.fz_i.data();
  // blocks of nodes keep their sums in the first-level cache while the slots go by
  constexpr int stride = 256;
  for (int from = 0; from < nodes; from += stride) {
    const int until = from + stride < nodes ? from + stride : nodes;
    for (int i = from; i < until; ++i) fr[i] = fz[i] = 0.0;
    for (int s = 0; s < slots; s += 4) {  // a multiple of 4, padded with the zero
      const int* __restrict a = slot + s * nodes;
      const int* __restrict b = a + nodes;
      const int* __restrict c = b + nodes;
      const int* __restrict d = c + nodes;
#pragma omp simd
      for (int i = from; i < until; ++i) {
        fr[i] += double((corner_fr[a[i]] + corner_fr[b[i]]) + (corner_fr[c[i]] + corner_fr[d[i]]));
        fz[i] += double((corner_fz[a[i]] + corner_fz[b[i]]) + (corner_fz[c[i]] + corner_fz[d[i]]));
      }
    }
  }
}

/// What becomes of the stresses.
enum class Then { forces, push_forward };

template <class Real>
void gather_block(Body& body, int first, int count, Block<Real>& block)
{
  if (body.corners == 4)
    gather<4, Real>(body, first, count, block);
  else
    gather<9, Real>(body, first, count, block);
}

template <class Real>
void pass_on(Body& body, int first, int count, const Block<Real>& block, Then then)
{
  if constexpr (std::is_same_v<Real, double>)
    if (then == Then::push_forward) return push_forward(body, first, count, block);
  if (body.corners == 4)
    corner_forces<4, Real>(body, first, count, block);
  else
    corner_forces<9, Real>(body, first, count, block);
}

/// One region under one pair of laws, block by block. A function of its own for each pair.
template <class Real, class Hardening, class Rate>
__attribute__((noinline)) void update_region(Body& body, const Region& region, Then then,
                                             const Hardening hardening, const Rate rate)
{
  Block<Real> block;
  for (int first = region.begin; first < region.end; first += block_points) {
    const int left = region.end - first, count = left < block_points ? left : block_points;
    gather_block<Real>(body, first, count, block);
    stress<Real>(body, region.moduli, first, count, block, hardening, rate);
    pass_on<Real>(body, first, count, block, then);
  }
}

/// Every region under its own laws.
template <class Real>
void update(Body& body, Then then)
{
  for (const Region& region : body.regions) {
    if (!region.moduli.yields && then == Then::forces)
      update_region<Real>(body, region, then, Elastic{}, no_rate);
    else if (!region.moduli.yields)
      update_region<Real>(body, region, then, ElasticWithState{}, no_rate);
    else if (region.moduli.flow.hardening == 0 && region.moduli.flow.rate == 0)
      update_region<Real>(body, region, then, flow::Linear{region.moduli.yield, region.moduli.hardening},
                          no_rate);
    else
      with_flow_laws(region.moduli, [&](auto hardening, auto rate) {
        update_region<Real>(body, region, then, hardening, rate);
      });
  }
  body.elapsed = 0.0;
}

void internal_force(Body& body, bool frozen)
{
  if (frozen) {
    for (const Region& region : body.regions)
      update_region<double>(body, region, Then::forces, Elastic{}, no_rate);
    sum_to_nodes<double>(body);
  } else if (body.is_single()) {
    update<float>(body, Then::forces);
    sum_to_nodes<float>(body);
  } else {
    update<double>(body, Then::forces);
    sum_to_nodes<double>(body);
  }
}

void update_stress(Body& body)
{
  update<double>(body, Then::push_forward);
}

void force_of_stress(Body& body)
{
  const MovingPoints& m = *body.moving;
  const double *trr = m.trr.data(), *tzz = m.tzz.data(), *trz = m.trz.data(), *thh = m.thh.data();
  Block<double> block;
  for (int first = 0; first < body.points; first += block_points) {
    const int left = body.points - first, count = left < block_points ? left : block_points;
    for (int p = 0; p < count; ++p) {
      const int at = first + p;
      block.prr[p] = trr[at], block.prz[p] = block.pzr[p] = trz[at];
      block.pzz[p] = tzz[at], block.phh[p] = thh[at];
    }
    corner_forces<9, double>(body, first, count, block);
  }
  // corners change from step to step: no list of them by node
  const int nodes = body.nodes, corners = 9 * body.points;
  const int* corner = body.corner_p.data();
  double *fr = body.fr_i.data(), *fz = body.fz_i.data();
  for (int i = 0; i < nodes; ++i) fr[i] = fz[i] = 0.0;
  for (int k = 0; k < corners; ++k) fr[corner[k]] += body.corner_fr[k], fz[corner[k]] += body.corner_fz[k];
}

void accelerate(Body& body, double dt)
{
  const int nodes = body.nodes;
  const double* __restrict w = body.inverse_mass_i.data();
  const double* __restrict fr = body.fr_i.data();
  const double* __restrict fz = body.fz_i.data();
  double* __restrict vr = body.vr_i.data();
  double* __restrict vz = body.vz_i.data();
#pragma omp simd
  for (int i = 0; i < nodes; ++i) {
    vr[i] += dt * w[i] * fr[i];
    vz[i] += dt * w[i] * fz[i];
  }
}

void move(Body& body, double dt)
{
  const int nodes = body.nodes;
  const double* __restrict vr = body.vr_i.data();
  const double* __restrict vz = body.vz_i.data();
  double* __restrict ur = body.ur_i.data();
  double* __restrict uz = body.uz_i.data();
#pragma omp simd
  for (int i = 0; i < nodes; ++i) {
    ur[i] += dt * vr[i];
    uz[i] += dt * vz[i];
  }
  body.elapsed += dt;
}

}  // namespace

extern const Kernels kernels{GRANULAW_ISA_NAME, internal_force, update_stress,
                             force_of_stress,   accelerate,     move};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
