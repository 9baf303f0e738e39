// Compiled once for each instruction set (CMakeLists.txt), with GRANULAW_ISA_NAMESPACE and GRANULAW_ISA_NAME
// set. Nothing here may come from a shared inline function: the linker would pick one copy for all sets.
// Hence raw pointers and compiler built-ins only.
//
// A force evaluation goes block by block through each region of the body, in three independent
// stages: gather (grid: displacement gradients), stress (material), corner_forces (grid).
#include <type_traits>

#include "solver/body/kernels.hpp"
#include "solver/body/node_loops.hpp"
#include "solver/material/axisymmetric_tensor.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

using namespace kernel;

template <class Real>
using Block = typename Axisymmetric<Real>::Block;

template <class Real>
GRANULAW_INLINE auto& state_in(Body& body)
{
  if constexpr (std::is_same_v<Real, float>)
    return body.single;
  else
    return body.state;
}
template <class Real>
GRANULAW_INLINE const CornerWeights<Real>& weights_in(const Reference& reference)
{
  if constexpr (std::is_same_v<Real, float>)
    return reference.corners.single;
  else
    return reference.corners.full;
}
template <class Real>
GRANULAW_INLINE const Real* volumes_in(const Reference& reference)
{
  if constexpr (std::is_same_v<Real, float>)
    return reference.single_volume_p.data();
  else
    return reference.volume_p.data();
}

/// Displacement gradients of `count` points from the `corners` nodes of each. Differences to the first node
/// are taken in double, so that float loses nothing to a common displacement.
template <int corners, class Real>
__attribute__((noinline)) void gather(const Body& body, int first, int count, Block<Real>& out)
{
  const Reference& reference = body.reference();
  const CornerWeights<Real>& weights = weights_in<Real>(reference);
  const int n = reference.points;
  const int* __restrict corner = reference.corners.node.data() + first;
  const Real* __restrict br = weights.br.data() + first;
  const Real* __restrict bz = weights.bz.data() + first;
  const Real* __restrict bh = weights.bh.data() + first;
  const Real* __restrict gamma = corners == 4 ? weights.hourglass.data() + first : nullptr;
  const double* __restrict ur = body.u_i.values.data();
  const double* __restrict uz = ur + body.u_i.nodes;
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
  const Reference& reference = body.reference();
  const CornerWeights<Real>& weights = weights_in<Real>(reference);
  PointState<Real>& state = state_in<Real>(body);
  const int n = reference.points;
  const Real* __restrict br = weights.br.data() + first;
  const Real* __restrict bz = weights.bz.data() + first;
  const Real* __restrict bh = weights.bh.data() + first;
  const Real* __restrict gamma = corners == 4 ? weights.hourglass.data() + first : nullptr;
  const Real* __restrict stiffness = corners == 4 ? weights.stiffness.data() + first : nullptr;
  const Real* __restrict volume = volumes_in<Real>(reference) + first;
  Real* __restrict energy = state.elastic_energy_p.data() + first;
  Real* __restrict corner_fr = state.corner_fr.data() + first;
  Real* __restrict corner_fz = state.corner_fz.data() + first;
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

template <class Real>
GRANULAW_INLINE BlockState<Axisymmetric<Real>> state_of(Body& body, int first)
{
  PointState<Real>& state = state_in<Real>(body);
  AlignedVector<Real>* c = state.c_p.data();
  return {{c[0].data() + first, c[1].data() + first, c[2].data() + first, c[3].data() + first},
          state.plastic_strain_p.data() + first,
          state.plastic_work_p.data() + first,
          state.elastic_energy_p.data() + first,
          volumes_in<Real>(body.reference()) + first};
}

/// `updated` grid: what the stages found for the displacements of one step becomes the points' own: elastic
/// left Cauchy-Green tensor and Kirchhoff stress after the step, both pushed forward through it.
__attribute__((noinline)) void push_forward(Body& body, int first, int count, const Block<double>& block)
{
  MovingPoints& m = *body.moving;
  AlignedVector<double>* c = body.state.c_p.data();
  double* __restrict crr = c[0].data() + first;
  double* __restrict czz = c[1].data() + first;
  double* __restrict crz = c[2].data() + first;
  double* __restrict chh = c[3].data() + first;
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
  const Reference& reference = body.reference();
  const PointState<Real>& state = state_in<Real>(body);
  const int nodes = reference.nodes, slots = reference.corners.slots;
  const int* __restrict slot = reference.corners.node_slots.data();
  const Real* __restrict corner_fr = state.corner_fr.data();
  const Real* __restrict corner_fz = state.corner_fz.data();
  double* __restrict fr = body.f_i.values.data();
  double* __restrict fz = fr + nodes;
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

/// Use of the stresses.
enum class Then { forces, push_forward };

template <class Real>
void gather_block(const Body& body, int first, int count, Block<Real>& block)
{
  if (body.reference().corners.each == 4)
    gather<4, Real>(body, first, count, block);
  else
    gather<9, Real>(body, first, count, block);
}

template <class Real>
void pass_on(Body& body, int first, int count, const Block<Real>& block, Then then)
{
  if constexpr (std::is_same_v<Real, double>)
    if (then == Then::push_forward) return push_forward(body, first, count, block);
  if (body.reference().corners.each == 4)
    corner_forces<4, Real>(body, first, count, block);
  else
    corner_forces<9, Real>(body, first, count, block);
}

/// Every region, block by block. `frozen`: nothing flows.
template <class Real>
void update(Body& body, Then then, bool frozen)
{
  const bool moves = then == Then::push_forward;
  const double per_dt = body.elapsed > 0.0 ? 1.0 / body.elapsed : 0.0;
  Block<Real> block;
  for (const Region& region : body.reference().regions) {
    Yielding<Real> yielding = yielding_of<Real>(region.moduli);
    if (frozen) yielding.find = nullptr;
    if (moves) yielding.has_state = true;
    for (int first = region.begin; first < region.end; first += block_points) {
      const int left = region.end - first, count = left < block_points ? left : block_points;
      gather_block<Real>(body, first, count, block);
      update_stress<Axisymmetric<Real>>(state_of<Real>(body, first), region.moduli, yielding, per_dt, moves,
                                        count, block);
      pass_on<Real>(body, first, count, block, then);
    }
  }
  if (!frozen) body.elapsed = 0.0;
}

void points_to_grid(Body& body)
{
  if (body.is_single()) {
    update<float>(body, Then::forces, false);
    sum_to_nodes<float>(body);
  } else {
    update<double>(body, Then::forces, false);
    sum_to_nodes<double>(body);
  }
}

void elastic_response(Body& body)
{
  body.fetch_state();
  update<double>(body, Then::forces, true);
  sum_to_nodes<double>(body);
}

void update_stress_of_points(Body& body)
{
  update<double>(body, Then::push_forward, false);
}

void force_of_stress(Body& body)
{
  const MovingPoints& m = *body.moving;
  const double *trr = m.trr.data(), *tzz = m.tzz.data(), *trz = m.trz.data(), *thh = m.thh.data();
  Block<double> block;
  const Reference& own = m.own;
  for (int first = 0; first < own.points; first += block_points) {
    const int left = own.points - first, count = left < block_points ? left : block_points;
    for (int p = 0; p < count; ++p) {
      const int at = first + p;
      block.prr[p] = trr[at], block.prz[p] = block.pzr[p] = trz[at];
      block.pzz[p] = tzz[at], block.phh[p] = thh[at];
    }
    corner_forces<9, double>(body, first, count, block);
  }
  // corners change from step to step: no list of them by node
  const int nodes = own.nodes, corners = 9 * own.points;
  const int* corner = own.corners.node.data();
  const double *corner_fr = body.state.corner_fr.data(), *corner_fz = body.state.corner_fz.data();
  double *fr = body.f_i.values.data(), *fz = fr + nodes;
  for (int i = 0; i < nodes; ++i) fr[i] = fz[i] = 0.0;
  for (int k = 0; k < corners; ++k) fr[corner[k]] += corner_fr[k], fz[corner[k]] += corner_fz[k];
}

/// Kirchhoff stress over J; plastic flow keeps the volume: J^2 = det b, b the elastic left Cauchy-Green
/// tensor.
void stress_of_moving_points(const Body& body, CauchyStress* points)
{
  const MovingPoints& m = *body.moving;
  const AlignedVector<double>* c = body.state.c_p.data();
  for (int p = 0; p < m.own.points; ++p) {
    const double rr = c[0][p], zz = c[1][p], rz = c[2][p], hh = c[3][p];
    const double per_j = 1 / root_of(((1 + rr) * (1 + zz) - rz * rz) * (1 + hh));
    points[p] = {m.trr[p] * per_j, m.thh[p] * per_j, m.tzz[p] * per_j, 0.0, m.trz[p] * per_j, 0.0};
  }
}

void stress(Body& body, CauchyStress* points)
{
  if (body.moving) return stress_of_moving_points(body, points);
  Block<double> block;
  for (const Region& region : body.reference().regions)
    for (int first = region.begin; first < region.end; first += block_points) {
      const int left = region.end - first, count = left < block_points ? left : block_points;
      gather_block<double>(body, first, count, block);
      cauchy_stress<Axisymmetric<double>>(state_of<double>(body, first), region.moduli, count, block,
                                          points + first);
    }
}

void momentum(const Body& body, double* of_body)
{
  const int nodes = body.v_i.nodes;
  const double* __restrict mass = body.reference().mass_i.data();
  const double* __restrict vz = body.v_i.values.data() + nodes;
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < nodes; ++i) sum += mass[i] * vz[i];
  of_body[0] = of_body[1] = of_body[3] = 0.0, of_body[2] = sum;
}

template <int corners>
GRANULAW_INLINE double growth_of(const Body& body)
{
  const Reference& reference = body.reference();
  const int n = reference.points;
  const int* __restrict corner = reference.corners.node.data();
  const double* __restrict br = reference.corners.full.br.data();
  const double* __restrict bz = reference.corners.full.bz.data();
  const double* __restrict ur = body.u_i.values.data();
  const double* __restrict uz = ur + reference.nodes;
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int p = 0; p < n; ++p) {
    double hrr = 0, hrz = 0, hzr = 0, hzz = 0, bound = 0;
#pragma GCC unroll 16
    for (int k = 0; k < corners; ++k) {
      const int at = k * n + p, i = corner[at];
      hrr += br[at] * ur[i], hrz += bz[at] * ur[i];
      hzr += br[at] * uz[i], hzz += bz[at] * uz[i];
      bound += br[at] * br[at] + bz[at] * bz[at];
    }
    const double frr = 1.0 + hrr, fzz = 1.0 + hzz;
    const double a = frr * frr + hzr * hzr, b = hrz * hrz + fzz * fzz, c = frr * hrz + hzr * fzz;
    const double least = 0.5 * (a + b) - root_of(0.25 * (a - b) * (a - b) + c * c);
    const double found = bound / (least > 1e-12 ? least : 1e-12);
    most = found > most ? found : most;
  }
  return most;
}

Growth growth(const Body& body)
{
  const Corners& corners = body.reference().corners;
  const double found = corners.each == 4 ? growth_of<4>(body) : growth_of<9>(body);
  const double at_rest = corners.bound_at_rest > 0.0 ? corners.bound_at_rest : 1.0;
  const double grown = found > at_rest || corners.bound_at_rest == 0.0 ? found / at_rest : 1.0;
  return {0.0, grown, grown, 1.0};
}

}  // namespace

extern const Kernels corner_kernels{points_to_grid, accelerate, move,    elastic_response,
                                    growth,         stress,     momentum};
extern const PointKernels point_kernels{update_stress_of_points, force_of_stress};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
