// Compiled once for each instruction set (CMakeLists.txt), with GRANULAW_ISA_NAMESPACE and GRANULAW_ISA_NAME
// set. Nothing here may come from a shared inline function: the linker would pick one copy for all sets.
// Hence raw pointers and compiler built-ins only.
//
// A force evaluation goes block by block through each region of the body, in three stages that know nothing
// of each other: gather (grid: displacement gradients), stress (material), corner_forces (grid).
#include <type_traits>

#include "solver/body/kernels.hpp"
#include "solver/material/axisymmetric_tensor.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

using namespace kernel;

template <class Real>
using Block = typename Axisymmetric<Real>::Block;

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

template <class Real>
GRANULAW_INLINE PointState<Axisymmetric<Real>> state_of(Body& body, int first)
{
  PointArrays<Real>& points = arrays<Real>(body);
  return {{points.crr_p.data() + first, points.czz_p.data() + first, points.crz_p.data() + first,
           points.chh_p.data() + first},
          points.plastic_strain_p.data() + first,
          points.plastic_work_p.data() + first,
          points.elastic_energy_p.data() + first,
          points.volume_p.data() + first};
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

/// Every region, block by block. `frozen`: nothing flows.
template <class Real>
void update(Body& body, Then then, bool frozen)
{
  const bool moves = then == Then::push_forward;
  const double per_dt = body.elapsed > 0.0 ? 1.0 / body.elapsed : 0.0;
  Block<Real> block;
  for (const Region& region : body.regions) {
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

void internal_force(Body& body, bool frozen)
{
  if (frozen) body.fetch_state();
  if (body.is_single() && !frozen) {
    update<float>(body, Then::forces, false);
    sum_to_nodes<float>(body);
  } else {
    update<double>(body, Then::forces, frozen);
    sum_to_nodes<double>(body);
  }
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

/// Kirchhoff stress over J; plastic flow keeps the volume: J^2 = det b, b the elastic left Cauchy-Green
/// tensor.
void stress_of_moving_points(const Body& body, CauchyStress* points)
{
  const MovingPoints& m = *body.moving;
  for (int p = 0; p < body.points; ++p) {
    const double rr = body.crr_p[p], zz = body.czz_p[p], rz = body.crz_p[p], hh = body.chh_p[p];
    const double per_j = 1 / root_of(((1 + rr) * (1 + zz) - rz * rz) * (1 + hh));
    points[p] = {m.trr[p] * per_j, m.thh[p] * per_j, m.tzz[p] * per_j, 0.0, m.trz[p] * per_j, 0.0};
  }
}

void stress(Body& body, CauchyStress* points)
{
  if (body.moving) return stress_of_moving_points(body, points);
  Block<double> block;
  for (const Region& region : body.regions)
    for (int first = region.begin; first < region.end; first += block_points) {
      const int left = region.end - first, count = left < block_points ? left : block_points;
      gather_block<double>(body, first, count, block);
      cauchy_stress<Axisymmetric<double>>(state_of<double>(body, first), region.moduli, count, block,
                                          points + first);
    }
}

double momentum(const Body& body)
{
  const int nodes = body.nodes;
  const double* __restrict mass = body.mass_i.data();
  const double* __restrict vz = body.vz_i.data();
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < nodes; ++i) sum += mass[i] * vz[i];
  return sum;
}

template <int corners>
GRANULAW_INLINE double growth_of(const Body& body)
{
  const int n = body.points;
  const int* __restrict corner = body.corner_p.data();
  const double* __restrict br = body.br_p.data();
  const double* __restrict bz = body.bz_p.data();
  const double* __restrict ur = body.ur_i.data();
  const double* __restrict uz = body.uz_i.data();
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

double growth(const Body& body)
{
  return body.corners == 4 ? growth_of<4>(body) : growth_of<9>(body);
}

}  // namespace

extern const Kernels kernels{
    GRANULAW_ISA_NAME, internal_force, update_stress_of_points, force_of_stress, accelerate, move, stress,
    momentum,          growth};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
