// Compiled once for each instruction set, as body/axisymmetric_isa.cpp, under the same rules.
//
// A force evaluation goes through each region of the body, eight cells at a time, in three independent
// stages: gather (grid: displacement gradients), stress (material), scatter (grid: forces).
// The eight octants of a cell are the lanes of a vector.
#include <type_traits>

#include "solver/body/kernels.hpp"
#include "solver/body/node_loops.hpp"
#include "solver/material/spatial_tensor.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

using namespace kernel;

/// One number for each octant of a cell, and for the four octants of one half.
template <class Real>
struct Vectors;
template <>
struct Vectors<double>
{
  typedef double Lanes __attribute__((vector_size(64), may_alias));
  typedef double HalfLanes __attribute__((vector_size(32), may_alias));
};
template <>
struct Vectors<float>
{
  typedef float Lanes __attribute__((vector_size(32), may_alias));
  typedef float HalfLanes __attribute__((vector_size(16), may_alias));
};
template <class Real>
using Lanes = typename Vectors<Real>::Lanes;
template <class Real>
using HalfLanes = typename Vectors<Real>::HalfLanes;

/// The part of a cell's octants that one register holds; nine sums of whole cells in double would spill
/// without AVX-512.
template <class Real>
struct Register
{
#ifdef __AVX512F__
  typedef Lanes<Real> Values;
#else
  typedef Real Values __attribute__((vector_size(32), may_alias));
#endif
  static constexpr int lanes = int(sizeof(Values) / sizeof(Real));
};

constexpr int block_cells = block_points / octants;

template <class Real>
using Block = typename Spatial<Real>::Block;

template <class Real>
GRANULAW_INLINE const Lanes<Real>& lanes(const Real* values)
{
  return *reinterpret_cast<const Lanes<Real>*>(values);
}
template <class Real>
GRANULAW_INLINE Lanes<Real>& lanes(Real* values)
{
  return *reinterpret_cast<Lanes<Real>*>(values);
}
template <class Real>
GRANULAW_INLINE const HalfLanes<Real>& half_lanes(const Real* values)
{
  return *reinterpret_cast<const HalfLanes<Real>*>(values);
}
template <class Real>
GRANULAW_INLINE HalfLanes<Real>& half_lanes(Real* values)
{
  return *reinterpret_cast<HalfLanes<Real>*>(values);
}
template <class Half>
GRANULAW_INLINE auto both_halves(Half v)
{
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 0, 1, 2, 3);
}
template <class Whole>
GRANULAW_INLINE auto sum_of_halves(Whole v)
{
  return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
/// Entry k: the sum of all entries of v[k].
template <class Half>
GRANULAW_INLINE Half row_sums(const Half (&v)[4])
{
  const Half a =
      __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6) + __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Half b =
      __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6) + __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
}

template <class Real>
GRANULAW_INLINE const CellWeights<Real>& weights_in(const SplineCells& cells)
{
  if constexpr (std::is_same_v<Real, float>)
    return cells.single;
  else
    return cells.full;
}

/// Raw pointers to the grid of a body.
template <class Real>
struct Grid
{
  const double* u;
  double* f;  ///< null: nothing is scattered
  const AxisWeights<Real>* axis[3];
  const SpatialCell* cells;
  const Real* cut_moments;
  long across, up;  ///< strides along y and z, in nodes; along x it is 1

  GRANULAW_MEMBER explicit Grid(const Body& body, double* force = nullptr)
      : Grid(body.u_i.values.data(), force, body.reference().cells)
  {
  }
  GRANULAW_MEMBER Grid(const double* displacement, double* force, const SplineCells& grid)
      : u(displacement),
        f(force),
        axis{weights_in<Real>(grid).axis[0].data(), weights_in<Real>(grid).axis[1].data(),
             weights_in<Real>(grid).axis[2].data()},
        cells(grid.cells.data()),
        cut_moments(weights_in<Real>(grid).cut_moments.data()),
        across(grid.count[0]),
        up(long(grid.count[0]) * grid.count[1])
  {
  }
  GRANULAW_MEMBER const Real* moments_of(const SpatialCell& cell) const
  {
    return cut_moments + long(cell.cut) * (cut_moments_each * octants);
  }
  /// Displacement of a node. Float: from that of the node `from`, a difference taken in double, so that
  /// nothing is lost to a common displacement.
  GRANULAW_MEMBER HalfLanes<Real> displacement(long node, [[maybe_unused]] long from) const
  {
    if constexpr (std::is_same_v<Real, float>)
      return __builtin_convertvector(half_lanes(u + 4 * node) - half_lanes(u + 4 * from), HalfLanes<float>);
    else
      return half_lanes(u + 4 * node);
  }
  GRANULAW_MEMBER void take_force(long node, HalfLanes<Real> force) const
  {
    half_lanes(f + 4 * node) -= __builtin_convertvector(force, HalfLanes<double>);
  }
};

/// Number of filled cells that follow each other along x from `first` on: 1 to `most`.
GRANULAW_INLINE int row_length(const SpatialCell* cells, int first, int most)
{
  int n = 1;
  while (n < most && cells[first + n].cut < 0 && cells[first + n].node == cells[first].node + n) ++n;
  return n;
}

/// Weights of the nine columns of nodes along x about a row of filled cells, for the octants of one half:
/// N N, N' N and N N' of y and z. Node 3 y + z of a column.
template <class Real>
struct RowWeights
{
  HalfLanes<Real> w[3][9];

  GRANULAW_MEMBER RowWeights(const AxisWeights<Real>& y, const AxisWeights<Real>& z)
  {
#pragma GCC unroll 3
    for (int b = 0; b < 3; ++b)
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        w[0][3 * b + c] = half_lanes(y.n[b]) * half_lanes(z.n[c]);
        w[1][3 * b + c] = half_lanes(y.dn[b]) * half_lanes(z.n[c]);
        w[2][3 * b + c] = half_lanes(y.n[b]) * half_lanes(z.dn[c]);
      }
  }
};

constexpr int row_nodes = block_cells + 2;  // along x about a row of eight cells

/// Displacement gradients of a row of filled cells: first along y and z at each node of x, then along x.
template <class Real>
__attribute__((noinline)) void gather_row(const Grid<Real>& grid, int first, int n, Real* __restrict h)
{
  const SpatialCell cell = grid.cells[first];
  const RowWeights<Real> weights(grid.axis[1][cell.column[1]], grid.axis[2][cell.column[2]]);
  HalfLanes<Real> at_node[row_nodes][9];  // [3 kind + component]
  for (int j = 0; j < n + 2; ++j) {
    HalfLanes<Real> sums[9]{};
#pragma GCC unroll 9
    for (int bc = 0; bc < 9; ++bc) {
      const HalfLanes<Real> u =
          grid.displacement(cell.node + j + bc / 3 * grid.across + bc % 3 * grid.up, cell.node);
#pragma GCC unroll 9
      for (int m = 0; m < 9; ++m) sums[m] += weights.w[m / 3][bc] * u[m % 3];
    }
#pragma GCC unroll 9
    for (int m = 0; m < 9; ++m) at_node[j][m] = sums[m];
  }
  for (int k = 0; k < n; ++k) {
    const AxisWeights<Real>& x = grid.axis[0][cell.column[0] + k];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      Lanes<Real> hx{}, hy{}, hz{};
#pragma GCC unroll 3
      for (int a = 0; a < 3; ++a) {
        hx += lanes(x.dn[a]) * both_halves(at_node[k + a][i]);
        hy += lanes(x.n[a]) * both_halves(at_node[k + a][3 + i]);
        hz += lanes(x.n[a]) * both_halves(at_node[k + a][6 + i]);
      }
      lanes(h + (3 * i + 0) * block_points + octants * k) = hx;
      lanes(h + (3 * i + 1) * block_points + octants * k) = hy;
      lanes(h + (3 * i + 2) * block_points + octants * k) = hz;
    }
  }
}

/// Forces of a row of filled cells, the transposed of gather_row.
template <class Real>
__attribute__((noinline)) void scatter_row(const Grid<Real>& grid, int first, int n, const Real* __restrict p)
{
  const SpatialCell cell = grid.cells[first];
  const RowWeights<Real> weights(grid.axis[1][cell.column[1]], grid.axis[2][cell.column[2]]);
  HalfLanes<Real> at_node[row_nodes][9];
  for (int j = 0; j < row_nodes; ++j)
#pragma GCC unroll 9
    for (int i = 0; i < 9; ++i) at_node[j][i] = HalfLanes<Real>{};
  for (int k = 0; k < n; ++k) {
    const AxisWeights<Real>& x = grid.axis[0][cell.column[0] + k];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Lanes<Real> px = lanes(p + (3 * i + 0) * block_points + octants * k);
      const Lanes<Real> py = lanes(p + (3 * i + 1) * block_points + octants * k);
      const Lanes<Real> pz = lanes(p + (3 * i + 2) * block_points + octants * k);
#pragma GCC unroll 3
      for (int a = 0; a < 3; ++a) {
        at_node[k + a][i] += sum_of_halves(lanes(x.dn[a]) * px);
        at_node[k + a][3 + i] += sum_of_halves(lanes(x.n[a]) * py);
        at_node[k + a][6 + i] += sum_of_halves(lanes(x.n[a]) * pz);
      }
    }
  }
  for (int j = 0; j < n + 2; ++j) {
    const HalfLanes<Real>(&node)[9] = at_node[j];
#pragma GCC unroll 9
    for (int bc = 0; bc < 9; ++bc) {
      HalfLanes<Real> sums[4]{};
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
        sums[i] =
            weights.w[0][bc] * node[i] + weights.w[1][bc] * node[3 + i] + weights.w[2][bc] * node[6 + i];
      grid.take_force(cell.node + j + bc / 3 * grid.across + bc % 3 * grid.up, row_sums(sums));
    }
  }
}

/// A cut cell as its moments see it. Where an axis is turned round (SpatialCell::along) the nodes run
/// backwards, and the outer splines change places.
template <class Real>
struct CutFrame
{
  long node, step[3];
  Real first[3], last[3];  ///< outer splines: first (1 - t)^2, last t^2
  Real per_edge[3];        ///< dt/dx

  GRANULAW_MEMBER CutFrame(const Grid<Real>& grid, const SpatialCell& cell)
      : node(cell.node), step{1, grid.across, grid.up}
  {
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d) {
      const AxisWeights<Real>& axis = grid.axis[d][cell.column[d]];
      const bool turned = cell.along[d] < 0;
      first[d] = turned ? axis.right : axis.left, last[d] = turned ? axis.left : axis.right;
      per_edge[d] = turned ? -axis.per_edge : axis.per_edge;
      node += turned ? 2 * step[d] : 0;
      step[d] = turned ? -step[d] : step[d];
    }
  }
  GRANULAW_MEMBER long node_of(int k) const
  {
    return node + k / 9 * step[0] + k / 3 % 3 * step[1] + k % 3 * step[2];
  }
};

/// Node values of a cell along one axis become coefficients of 1, t, t^2/2.
template <int stride, class Real>
GRANULAW_INLINE void to_polynomials(HalfLanes<Real> (&c)[cell_nodes], Real first, Real last)
{
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) {
    const int at = k / stride * 3 * stride + k % stride;
    const HalfLanes<Real> middle = c[at + stride];
    const HalfLanes<Real> p = first * (c[at] - middle), q = last * (c[at + 2 * stride] - middle);
    c[at] = middle + p, c[at + stride] = Real(-2) * p, c[at + 2 * stride] = Real(2) * (p + q);
  }
}

/// The transposed of to_polynomials.
template <int stride, class Real>
GRANULAW_INLINE void to_nodes(HalfLanes<Real> (&c)[cell_nodes], Real first, Real last)
{
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) {
    const int at = k / stride * 3 * stride + k % stride;
    const HalfLanes<Real> all = c[at], twice = Real(2) * c[at + 2 * stride];
    c[at] = first * (all - Real(2) * c[at + stride] + twice), c[at + 2 * stride] = last * twice;
    c[at + stride] = all - c[at] - c[at + 2 * stride];
  }
}

/// Displacement gradients of a cell that the surface or an interface cuts: the polynomial of the
/// displacement, and the mean of its derivatives over each piece by the piece's moments.
template <class Real>
__attribute__((noinline)) void gather_cut(const Grid<Real>& grid, const SpatialCell& cell, Real* __restrict h)
{
  const Real* __restrict moments = grid.moments_of(cell);
  const CutFrame<Real> frame(grid, cell);
  HalfLanes<Real> c[cell_nodes];
#pragma GCC unroll 27
  for (int k = 0; k < cell_nodes; ++k) c[k] = grid.displacement(frame.node_of(k), cell.node);
  to_polynomials<9, Real>(c, frame.first[0], frame.last[0]);
  to_polynomials<3, Real>(c, frame.first[1], frame.last[1]);
  to_polynomials<1, Real>(c, frame.first[2], frame.last[2]);
  const Real* __restrict coefficient = reinterpret_cast<const Real*>(c);
  using Values = typename Register<Real>::Values;
  for (int lane = 0; lane < octants; lane += Register<Real>::lanes) {
    Values sums[9]{};
#pragma GCC unroll 26
    for (int k = 0; k < cut_moments_each; ++k) {
      const Values moment = *reinterpret_cast<const Values*>(moments + k * octants + lane);
      const int power[3] = {k / 9, k / 3 % 3, k % 3}, step[3] = {9, 3, 1};
#pragma GCC unroll 3
      for (int d = 0; d < 3; ++d)
        if (power[d] < 2)
#pragma GCC unroll 3
          for (int i = 0; i < 3; ++i) sums[3 * i + d] += moment * coefficient[4 * (k + step[d]) + i];
    }
#pragma GCC unroll 9
    for (int m = 0; m < 9; ++m)
      *reinterpret_cast<Values*>(h + m * block_points + lane) = sums[m] * frame.per_edge[m % 3];
  }
}

/// Forces of a cut cell, the transposed of gather_cut.
template <class Real>
__attribute__((noinline)) void scatter_cut(const Grid<Real>& grid, const SpatialCell& cell,
                                           const Real* __restrict p)
{
  const Real* __restrict moments = grid.moments_of(cell);
  const CutFrame<Real> frame(grid, cell);
  Lanes<Real> stress[9];
#pragma GCC unroll 9
  for (int m = 0; m < 9; ++m) stress[m] = lanes(p + m * block_points) * frame.per_edge[m % 3];
  HalfLanes<Real> c[cell_nodes];
  c[0] = HalfLanes<Real>{};
#pragma GCC unroll 26
  for (int k = 1; k < cell_nodes; ++k) {
    const int power[3] = {k / 9, k / 3 % 3, k % 3}, step[3] = {9, 3, 1};
    Lanes<Real> sums[3]{};
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d)
      if (power[d] > 0) {
        const Lanes<Real> moment = lanes(moments + (k - step[d]) * octants);
#pragma GCC unroll 3
        for (int i = 0; i < 3; ++i) sums[i] += stress[3 * i + d] * moment;
      }
    const HalfLanes<Real> halves[4] = {sum_of_halves(sums[0]), sum_of_halves(sums[1]), sum_of_halves(sums[2]),
                                       HalfLanes<Real>{}};
    c[k] = row_sums(halves);
  }
  to_nodes<1, Real>(c, frame.first[2], frame.last[2]);
  to_nodes<3, Real>(c, frame.first[1], frame.last[1]);
  to_nodes<9, Real>(c, frame.first[0], frame.last[0]);
#pragma GCC unroll 27
  for (int k = 0; k < cell_nodes; ++k) grid.take_force(frame.node_of(k), c[k]);
}

/// Calls row(first, length) for each row of filled cells and cut(cell) for each cut one in [first, end).
template <class Real, class Row, class Cut>
GRANULAW_INLINE void each_part(const Grid<Real>& grid, int first, int end, Row row, Cut cut)
{
  while (first < end) {
    if (grid.cells[first].cut >= 0) {
      cut(first);
      ++first;
      continue;
    }
    const int n = row_length(grid.cells, first, end - first);
    row(first, n);
    first += n;
  }
}

template <class Real>
GRANULAW_INLINE void gather(const Grid<Real>& grid, int first, int end, Block<Real>& block)
{
  each_part(
      grid, first, end,
      [&](int at, int n)
          __attribute__((always_inline)) { gather_row(grid, at, n, block.h[0] + octants * (at - first)); },
      [&](int at) __attribute__((always_inline)) {
        gather_cut(grid, grid.cells[at], block.h[0] + octants * (at - first));
      });
}

template <class Real>
GRANULAW_INLINE void scatter(const Grid<Real>& grid, int first, int end, const Block<Real>& block)
{
  each_part(
      grid, first, end,
      [&](int at, int n)
          __attribute__((always_inline)) { scatter_row(grid, at, n, block.h[0] + octants * (at - first)); },
      [&](int at) __attribute__((always_inline)) {
        scatter_cut(grid, grid.cells[at], block.h[0] + octants * (at - first));
      });
}

template <class Real>
GRANULAW_INLINE BlockState<Spatial<Real>> state_from(PointState<Real>& state, const Real* volume, int first)
{
  AlignedVector<Real>* c = state.c_p.data();
  return {{c[0].data() + first, c[1].data() + first, c[2].data() + first, c[3].data() + first,
           c[4].data() + first, c[5].data() + first},
          state.plastic_strain_p.data() + first,
          state.plastic_work_p.data() + first,
          state.elastic_energy_p.data() + first,
          volume + first};
}
template <class Real>
GRANULAW_INLINE BlockState<Spatial<Real>> state_of(Body& body, int first)
{
  if constexpr (std::is_same_v<Real, float>)
    return state_from(body.single, body.reference().single_volume_p.data(), first);
  else
    return state_from(body.state, body.reference().volume_p.data(), first);
}

/// Every region, block by block. `frozen`: nothing flows.
template <class Real>
void update(Body& body, bool frozen)
{
  const Grid<Real> grid(body, body.f_i.values.data());
  const double per_dt = body.elapsed > 0.0 ? 1.0 / body.elapsed : 0.0;
  Block<Real> block;
  for (const Region& region : body.reference().regions) {
    Yielding<Real> yielding = yielding_of<Real>(region.moduli);
    if (frozen) yielding.find = nullptr;
    for (int first = region.begin / octants, last = region.end / octants; first < last;
         first += block_cells) {
      const int end = first + block_cells < last ? first + block_cells : last;
      gather<Real>(grid, first, end, block);
      update_stress<Spatial<Real>>(state_of<Real>(body, octants * first), region.moduli, yielding, per_dt,
                                   false, octants * (end - first), block);
      scatter<Real>(grid, first, end, block);
    }
  }
}

void points_to_grid(Body& body)
{
  double* __restrict f = body.f_i.values.data();
  for (int i = 0; i < 4 * body.f_i.nodes; ++i) f[i] = 0.0;
  if (body.is_single())
    update<float>(body, false);
  else
    update<double>(body, false);
  body.elapsed = 0.0;
}

void elastic_response(Body& body)
{
  body.fetch_state();
  double* __restrict f = body.f_i.values.data();
  const double* __restrict inverse_mass = body.reference().inverse_mass_i.values.data();
  for (int i = 0; i < 4 * body.f_i.nodes; ++i) f[i] = 0.0;
  update<double>(body, true);
  for (int i = 0; i < 4 * body.f_i.nodes; ++i) f[i] = inverse_mass[i] > 0.0 ? f[i] : 0.0;
}

/// Largest eigenvalue of a positive tensor, from above by less than 1 %: with equal smaller ones the first
/// estimate is exact (Smith 1961), elsewhere Newton's steps on the characteristic polynomial come down to it.
template <class Real>
GRANULAW_INLINE Real largest_eigenvalue(const Symmetric<Real>& a)
{
  const Real mean = trace_of(a) * Real(1.0 / 3.0);
  const Symmetric<Real> d{a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.xz, a.yz};
  const Real second = Real(0.5) * square_of(d), third = determinant_of(d);
  Real x = Real(2) * root_of(second * Real(1.0 / 3.0));
#pragma GCC unroll 3
  for (int n = 0; n < 3; ++n) {
    const Real slope = Real(3) * x * x - second;
    x -= (x * (x * x - second) - third) / (slope + tiny<Real>);
  }
  return mean + x;
}

/// Largest 1 + share (ratio - 1) and least det F of the octants of one cell, ratio the largest eigenvalue of
/// A A^T (Growth) over `at_rest`, times the stiffening under pressure, of which `bulk_share` is K/M.
template <class Real>
GRANULAW_INLINE void measure_cell(const Block<Real>& block, int first, const Real (&per_edge)[3],
                                  Real at_rest, Real bulk_share, const double* __restrict share,
                                  Real& largest, Real& least_volume)
{
  Real most = 0, least = 1;
#pragma omp simd reduction(max : most) reduction(min : least)
  for (int lane = 0; lane < octants; ++lane) {
    const Deformation<Real> d = Spatial<Real>::deformation(block, first + lane);
    const Real(&a)[3][3] = d.adjugate;
    const auto entry = [&](int i, int j) __attribute__((always_inline))
    {
      return per_edge[i] * per_edge[j] * (a[i][0] * a[j][0] + a[i][1] * a[j][1] + a[i][2] * a[j][2]);
    };
    const Real pressed = d.determinant < Real(1) ? d.determinant : Real(1);
    // -ln J from above: by 0.5 % at J = 0.7, 5 % at 0.33
    const Real squeeze = (Real(1) - pressed) / root_of(pressed > tiny<Real> ? pressed : tiny<Real>);
    const Real found = (Real(1) + bulk_share * squeeze) *
                       largest_eigenvalue<Real>(
                           {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)}) /
                       (d.determinant * d.determinant * at_rest);
    const Real counted = Real(1) + Real(share[lane]) * (found - Real(1));
    most = counted > most ? counted : most;
    // not a number counts as turned inside out
    least = d.determinant > least ? least : (d.determinant == d.determinant ? d.determinant : Real(-1));
  }
  largest = most, least_volume = least;
}

template <class Real>
GRANULAW_INLINE Growth growth_of(const Body& body)
{
  const Grid<Real> grid(body);
  constexpr double whole[octants] = {1, 1, 1, 1, 1, 1, 1, 1};
  Growth found{0.0, 1.0, 1.0, 1.0};
  const auto raise = [](double& most, double value) __attribute__((always_inline))
  {
    most = value > most ? value : most;
  };
  Block<Real> block;
  for (const Region& region : body.reference().regions) {
    const Moduli& m = region.moduli;
    const Real bulk_share = Real(m.bulk / (m.bulk + 4.0 / 3.0 * m.shear));
    for (int first = region.begin / octants, last = region.end / octants; first < last;
         first += block_cells) {
      const int end = first + block_cells < last ? first + block_cells : last;
      gather<Real>(grid, first, end, block);
      for (int cell = first; cell < end; ++cell) {
        Real per_edge[3], ratio, volume;
        double finest = 0.0;
        for (int d = 0; d < 3; ++d) {
          per_edge[d] = grid.axis[d][grid.cells[cell].column[d]].per_edge;
          raise(finest, per_edge[d]);
        }
        const int cut = grid.cells[cell].cut;
        const double* share =
            cut >= 0 ? body.reference().cells.step_share.data() + octants * std::size_t(cut) : whole;
        measure_cell<Real>(block, octants * (cell - first), per_edge, Real(finest * finest), bulk_share,
                           share, ratio, volume);
        raise(found.largest, ratio);
        if (cut >= 0)
          raise(found.cut, ratio);
        else
          raise(found.filled_omega2, 1.5 * region.wave_speed2 * finest * finest * double(ratio));
        found.least_volume = volume < found.least_volume ? double(volume) : found.least_volume;
      }
    }
  }
  return found;
}

Growth growth(const Body& body)
{
  return body.is_single() ? growth_of<float>(body) : growth_of<double>(body);
}

void stress(Body& body, CauchyStress* points)
{
  const Grid<double> grid(body);
  Block<double> block;
  for (const Region& region : body.reference().regions)
    for (int first = region.begin / octants, last = region.end / octants; first < last;
         first += block_cells) {
      const int end = first + block_cells < last ? first + block_cells : last;
      gather<double>(grid, first, end, block);
      cauchy_stress<Spatial<double>>(state_of<double>(body, octants * first), region.moduli,
                                     octants * (end - first), block, points + octants * first);
    }
}

void momentum(const Body& body, double* sum)
{
  const int nodes = body.v_i.nodes;
  const double* mass = body.reference().mass_i.data();
  const double* v = body.v_i.values.data();
  HalfLanes<double> sums[2]{};
  const int even = nodes & ~1;
  for (int i = 0; i < even; i += 2) {
    sums[0] += mass[i] * half_lanes(v + 4 * i);
    sums[1] += mass[i + 1] * half_lanes(v + 4 * i + 4);
  }
  if (even < nodes) sums[0] += mass[even] * half_lanes(v + 4 * even);
  const HalfLanes<double> all = sums[0] + sums[1];
  for (int c = 0; c < 4; ++c) sum[c] = all[c];
}

}  // namespace

extern const Kernels cell_kernels{points_to_grid, accelerate, move,    elastic_response,
                                  growth,         stress,     momentum};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
