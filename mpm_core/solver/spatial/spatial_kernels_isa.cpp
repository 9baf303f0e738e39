// Compiled once for each instruction set, as kernels_isa.cpp, under the same rules.
//
// A force evaluation goes through each region of the body, eight cells at a time, in three stages that know
// nothing of each other: gather (grid: displacement gradients), stress (material), scatter (grid: forces).
// The eight octants of a cell are the lanes of a vector.
#include <type_traits>

#include "solver/kernel_flow.hpp"
#include "solver/kernel_math.hpp"
#include "solver/spatial/spatial_kernels.hpp"

namespace granulaw::GRANULAW_ISA_NAMESPACE {

namespace {

using namespace kernel;

/// One double for each octant of a cell, and for the four octants of one half.
typedef double Lanes __attribute__((vector_size(64), may_alias));
typedef double HalfLanes __attribute__((vector_size(32), may_alias));

constexpr int block_cells = block_points / octants;

/// What the stages hand on for the points of one block. [3 i + j]: component i, derivative by x_j.
struct alignas(64) Block
{
  double h[9][block_points];  ///< displacement gradient, F = 1 + h; after the stress update first
                              ///< Piola-Kirchhoff stress times volume
};

GRANULAW_INLINE const Lanes& lanes(const double* values)
{
  return *reinterpret_cast<const Lanes*>(values);
}
GRANULAW_INLINE Lanes& lanes(double* values)
{
  return *reinterpret_cast<Lanes*>(values);
}
GRANULAW_INLINE const HalfLanes& half_lanes(const double* values)
{
  return *reinterpret_cast<const HalfLanes*>(values);
}
GRANULAW_INLINE HalfLanes& half_lanes(double* values)
{
  return *reinterpret_cast<HalfLanes*>(values);
}
GRANULAW_INLINE Lanes both_halves(HalfLanes v)
{
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 0, 1, 2, 3);
}
GRANULAW_INLINE HalfLanes sum_of_halves(Lanes v)
{
  return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
/// Entry k: the sum of all entries of v[k].
GRANULAW_INLINE HalfLanes row_sums(const HalfLanes (&v)[4])
{
  const HalfLanes a =
      __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6) + __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const HalfLanes b =
      __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6) + __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
}

/// Raw pointers to the grid of a body.
struct Grid
{
  const double* u;
  double* f;
  const AxisWeights* axis[3];
  const SpatialCell* cells;
  const double* cut_moments;
  long across, up;  ///< strides along y and z, in nodes; along x it is 1

  GRANULAW_MEMBER explicit Grid(SpatialBody& body)
      : u(body.u_i.data()),
        f(body.f_i.data()),
        axis{body.axis_weights[0].data(), body.axis_weights[1].data(), body.axis_weights[2].data()},
        cells(body.cells.data()),
        cut_moments(body.cut_moments.data()),
        across(body.count[0]),
        up(long(body.count[0]) * body.count[1])
  {
  }
  GRANULAW_MEMBER const double* moments_of(const SpatialCell& cell) const
  {
    return cut_moments + long(cell.cut) * (cut_moments_each * octants);
  }
};

/// How many cells from `first` on, at most `most`, are filled and follow each other along x; at least 1.
GRANULAW_INLINE int row_length(const SpatialCell* cells, int first, int most)
{
  int n = 1;
  while (n < most && cells[first + n].cut < 0 && cells[first + n].node == cells[first].node + n) ++n;
  return n;
}

/// Weights of the nine columns of nodes along x about a row of filled cells, for the octants of one half:
/// N N, N' N and N N' of y and z. Node 3 y + z of a column.
struct RowWeights
{
  HalfLanes w[3][9];

  GRANULAW_MEMBER RowWeights(const AxisWeights& y, const AxisWeights& z)
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
__attribute__((noinline)) void gather_row(const Grid& grid, int first, int n, double* __restrict h)
{
  const SpatialCell cell = grid.cells[first];
  const RowWeights weights(grid.axis[1][cell.column[1]], grid.axis[2][cell.column[2]]);
  HalfLanes at_node[row_nodes][9];  // [3 kind + component]
  for (int j = 0; j < n + 2; ++j)
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const double* __restrict u = grid.u + 4 * (cell.node + j) + i;
      HalfLanes nn{}, dn{}, nd{};
#pragma GCC unroll 3
      for (int b = 0; b < 3; ++b)
#pragma GCC unroll 3
        for (int c = 0; c < 3; ++c) {
          const double value = u[4 * (b * grid.across + c * grid.up)];
          nn += weights.w[0][3 * b + c] * value;
          dn += weights.w[1][3 * b + c] * value;
          nd += weights.w[2][3 * b + c] * value;
        }
      at_node[j][i] = nn, at_node[j][3 + i] = dn, at_node[j][6 + i] = nd;
    }
  for (int k = 0; k < n; ++k) {
    const AxisWeights& x = grid.axis[0][cell.column[0] + k];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      Lanes hx{}, hy{}, hz{};
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
__attribute__((noinline)) void scatter_row(const Grid& grid, int first, int n, const double* __restrict p)
{
  const SpatialCell cell = grid.cells[first];
  const RowWeights weights(grid.axis[1][cell.column[1]], grid.axis[2][cell.column[2]]);
  HalfLanes at_node[row_nodes][9];
  for (int j = 0; j < row_nodes; ++j)
#pragma GCC unroll 9
    for (int i = 0; i < 9; ++i) at_node[j][i] = HalfLanes{};
  for (int k = 0; k < n; ++k) {
    const AxisWeights& x = grid.axis[0][cell.column[0] + k];
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Lanes px = lanes(p + (3 * i + 0) * block_points + octants * k);
      const Lanes py = lanes(p + (3 * i + 1) * block_points + octants * k);
      const Lanes pz = lanes(p + (3 * i + 2) * block_points + octants * k);
#pragma GCC unroll 3
      for (int a = 0; a < 3; ++a) {
        at_node[k + a][i] += sum_of_halves(lanes(x.dn[a]) * px);
        at_node[k + a][3 + i] += sum_of_halves(lanes(x.n[a]) * py);
        at_node[k + a][6 + i] += sum_of_halves(lanes(x.n[a]) * pz);
      }
    }
  }
  for (int j = 0; j < n + 2; ++j) {
    const HalfLanes(&node)[9] = at_node[j];
#pragma GCC unroll 9
    for (int bc = 0; bc < 9; ++bc) {
      HalfLanes sums[4]{};
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
        sums[i] =
            weights.w[0][bc] * node[i] + weights.w[1][bc] * node[3 + i] + weights.w[2][bc] * node[6 + i];
      half_lanes(grid.f + 4 * (cell.node + j + bc / 3 * grid.across + bc % 3 * grid.up)) -= row_sums(sums);
    }
  }
}

/// Node values of a cell along one axis become coefficients of 1, xi, xi^2/2.
template <int stride>
GRANULAW_INLINE void to_polynomials(HalfLanes (&c)[cell_nodes], const AxisWeights& axis)
{
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) {
    const int at = k / stride * 3 * stride + k % stride;
    const HalfLanes middle = c[at + stride];
    const HalfLanes p = axis.left * (c[at] - middle), q = axis.right * (c[at + 2 * stride] - middle);
    const HalfLanes sum = p + q;
    c[at] = middle + 0.25 * sum, c[at + stride] = q - p, c[at + 2 * stride] = 2.0 * sum;
  }
}

/// The transposed of to_polynomials.
template <int stride>
GRANULAW_INLINE void to_nodes(HalfLanes (&c)[cell_nodes], const AxisWeights& axis)
{
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) {
    const int at = k / stride * 3 * stride + k % stride;
    const HalfLanes all = c[at], sum = 0.25 * all + 2.0 * c[at + 2 * stride];
    c[at] = axis.left * (sum - c[at + stride]), c[at + 2 * stride] = axis.right * (sum + c[at + stride]);
    c[at + stride] = all - c[at] - c[at + 2 * stride];
  }
}

/// Displacement gradients of a cell that the surface or an interface cuts: the polynomial of the
/// displacement, and the mean of its derivatives over each piece by the piece's moments.
__attribute__((noinline)) void gather_cut(const Grid& grid, const SpatialCell& cell, double* __restrict h)
{
  const double* __restrict moments = grid.moments_of(cell);
  const AxisWeights* axis[3];
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) axis[d] = grid.axis[d] + cell.column[d];
  HalfLanes c[cell_nodes];
#pragma GCC unroll 27
  for (int k = 0; k < cell_nodes; ++k)
    c[k] = half_lanes(grid.u + 4 * (cell.node + k / 9 + k / 3 % 3 * grid.across + k % 3 * grid.up));
  to_polynomials<9>(c, *axis[0]);
  to_polynomials<3>(c, *axis[1]);
  to_polynomials<1>(c, *axis[2]);
  const double* __restrict coefficient = reinterpret_cast<const double*>(c);
  Lanes sums[9]{};
#pragma GCC unroll 26
  for (int k = 0; k < cut_moments_each; ++k) {
    const Lanes moment = lanes(moments + k * octants);
    const int power[3] = {k / 9, k / 3 % 3, k % 3}, step[3] = {9, 3, 1};
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d)
      if (power[d] < 2)
#pragma GCC unroll 3
        for (int i = 0; i < 3; ++i) sums[3 * i + d] += moment * coefficient[4 * (k + step[d]) + i];
  }
#pragma GCC unroll 9
  for (int m = 0; m < 9; ++m) lanes(h + m * block_points) = sums[m] * axis[m % 3]->per_edge;
}

/// Forces of a cut cell, the transposed of gather_cut.
__attribute__((noinline)) void scatter_cut(const Grid& grid, const SpatialCell& cell,
                                           const double* __restrict p)
{
  const double* __restrict moments = grid.moments_of(cell);
  const AxisWeights* axis[3];
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) axis[d] = grid.axis[d] + cell.column[d];
  Lanes stress[9];
#pragma GCC unroll 9
  for (int m = 0; m < 9; ++m) stress[m] = lanes(p + m * block_points) * axis[m % 3]->per_edge;
  HalfLanes c[cell_nodes];
  c[0] = HalfLanes{};
#pragma GCC unroll 26
  for (int k = 1; k < cell_nodes; ++k) {
    const int power[3] = {k / 9, k / 3 % 3, k % 3}, step[3] = {9, 3, 1};
    Lanes sums[3]{};
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d)
      if (power[d] > 0) {
        const Lanes moment = lanes(moments + (k - step[d]) * octants);
#pragma GCC unroll 3
        for (int i = 0; i < 3; ++i) sums[i] += stress[3 * i + d] * moment;
      }
    const HalfLanes halves[4] = {sum_of_halves(sums[0]), sum_of_halves(sums[1]), sum_of_halves(sums[2]),
                                 HalfLanes{}};
    c[k] = row_sums(halves);
  }
  to_nodes<1>(c, *axis[2]);
  to_nodes<3>(c, *axis[1]);
  to_nodes<9>(c, *axis[0]);
#pragma GCC unroll 27
  for (int k = 0; k < cell_nodes; ++k)
    half_lanes(grid.f + 4 * (cell.node + k / 9 + k / 3 % 3 * grid.across + k % 3 * grid.up)) -= c[k];
}

/// Calls row(first, length) for each row of filled cells and cut(cell) for each cut one in [first, end).
template <class Row, class Cut>
GRANULAW_INLINE void each_part(const Grid& grid, int first, int end, Row row, Cut cut)
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

GRANULAW_INLINE void gather(const Grid& grid, int first, int end, Block& block)
{
  each_part(
      grid, first, end,
      [&](int at, int n)
          __attribute__((always_inline)) { gather_row(grid, at, n, block.h[0] + octants * (at - first)); },
      [&](int at) __attribute__((always_inline)) {
        gather_cut(grid, grid.cells[at], block.h[0] + octants * (at - first));
      });
}

GRANULAW_INLINE void scatter(const Grid& grid, int first, int end, const Block& block)
{
  each_part(
      grid, first, end,
      [&](int at, int n)
          __attribute__((always_inline)) { scatter_row(grid, at, n, block.h[0] + octants * (at - first)); },
      [&](int at) __attribute__((always_inline)) {
        scatter_cut(grid, grid.cells[at], block.h[0] + octants * (at - first));
      });
}

/// A symmetric tensor.
struct Symmetric
{
  double xx, yy, zz, xy, xz, yz;
};

GRANULAW_INLINE double trace_of(const Symmetric& a)
{
  return a.xx + a.yy + a.zz;
}
GRANULAW_INLINE double determinant_of(const Symmetric& a)
{
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
         a.xz * (a.xy * a.yz - a.yy * a.xz);
}
/// a : a
GRANULAW_INLINE double square_of(const Symmetric& a)
{
  return a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + 2.0 * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz);
}
/// a b of two tensors that commute.
GRANULAW_INLINE Symmetric product(const Symmetric& a, const Symmetric& b)
{
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
          a.xz * b.xz + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.xy * b.xz + a.yy * b.yz + a.yz * b.zz};
}
/// p 1 + q a + r b
GRANULAW_INLINE Symmetric combination(double p, double q, const Symmetric& a, double r, const Symmetric& b)
{
  return {p + q * a.xx + r * b.xx, p + q * a.yy + r * b.yy, p + q * a.zz + r * b.zz,
          q * a.xy + r * b.xy,     q * a.xz + r * b.xz,     q * a.yz + r * b.yz};
}

/// Logarithmic strain e = ln(b)/2 of a positive b: its deviator and its trace.
struct LogarithmicStrain
{
  Symmetric deviator;
  double trace;
};

/// Of b = 1 + x. With m = 1 + tr(x)/3 and d the deviator of x, b = m + d:
///
///     ln(b)/2 = ln(m)/2 + artanh(s),    s = d (d + 2 m)^-1 = (I3 + w^2 d - w d^2)/(w^3 + w I2 + I3),  w = 2
///     m,
///
/// I2, I3 the invariants of d (Cayley-Hamilton: d^3 + I2 d - I3 = 0). The series of artanh(s)/s in s^2 is
/// summed in the basis 1, s^2, s^4 by the characteristic polynomial of s^2. Its eight terms leave 1e-18 of it
/// at deviatoric strains of 0.1, 1e-11 at 0.27, 1e-8 at 0.4; no principal axes are needed, and small strains
/// are exact to rounding.
GRANULAW_INLINE LogarithmicStrain logarithmic_strain(const Symmetric& x)
{
  const double mean = trace_of(x) * (1.0 / 3.0);
  const Symmetric d{x.xx - mean, x.yy - mean, x.zz - mean, x.xy, x.xz, x.yz};
  const Symmetric d2 = product(d, d);
  const double second = -0.5 * trace_of(d2), third = determinant_of(d), w = 2.0 + 2.0 * mean;
  const double per = 1.0 / (w * (w * w + second) + third);
  const Symmetric s = combination(third * per, w * w * per, d, -w * per, d2);
  const Symmetric z = product(s, s);
  const double j1 = trace_of(s), j2 = 0.5 * (j1 * j1 - trace_of(z)), j3 = determinant_of(s);
  const double k1 = j1 * j1 - 2.0 * j2, k2 = j2 * j2 - 2.0 * j1 * j3, k3 = j3 * j3;  // invariants of s^2
  double p = 1.0 / 15.0, q = 0.0, r = 0.0;
#pragma GCC unroll 7
  for (int n = 6; n >= 0; --n) {
    const double pn = 1.0 / (2.0 * n + 1.0) + r * k3, qn = p - r * k2, rn = q + r * k1;
    p = pn, q = qn, r = rn;
  }
  // artanh(s) = p s + q s^3 + r s^5, and s^3 = j3 - j2 s + j1 s^2
  const double one = q * j3 + r * (j1 * j1 * j3 - j2 * j3);
  const double first = p - q * j2 + r * (j1 * j3 - j1 * j1 * j2 + j2 * j2);
  const double square = q * j1 + r * (j1 * j1 * j1 - 2.0 * j1 * j2 + j3);
  const Symmetric g = combination(one, first, s, square, z);
  const double trace = trace_of(g), part = trace * (1.0 / 3.0);
  return {{g.xx - part, g.yy - part, g.zz - part, g.xy, g.xz, g.yz}, 1.5 * log_1p(mean) + trace};
}

/// exp(a) - 1 of a small tensor without trace, such as one time step's plastic flow; eight terms.
GRANULAW_INLINE Symmetric exponential_m1(const Symmetric& a)
{
  const Symmetric square = product(a, a);
  const double second = -0.5 * trace_of(square), third = determinant_of(a);
  // sum of a^n/(n + 1)! in the basis 1, a, a^2, with a^3 = third - second a
  constexpr double per_factorial[] = {1.0, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040};
  double p = 1.0 / 40320, q = 0.0, r = 0.0;
#pragma GCC unroll 7
  for (int n = 6; n >= 0; --n) {
    const double pn = per_factorial[n] + r * third, qn = p - r * second, rn = q;
    p = pn, q = qn, r = rn;
  }
  return combination(r * third, p - r * second, a, q, square);
}

/// Of the points of a block: the state with all plastic flow of the step undone, and what flows.
struct alignas(64) Trials
{
  double x[6][block_points];         ///< elastic left Cauchy-Green tensor minus identity
  double deviator[6][block_points];  ///< of the elastic logarithmic strain
  double trace[block_points];        ///< and its trace, ln J
  double q[block_points], jacobian[block_points], strain[block_points], stress[block_points];

  GRANULAW_MEMBER static Symmetric read(const double (&a)[6][block_points], int p)
  {
    return {a[0][p], a[1][p], a[2][p], a[3][p], a[4][p], a[5][p]};
  }
  GRANULAW_MEMBER static void write(double (&a)[6][block_points], int p, const Symmetric& s)
  {
    a[0][p] = s.xx, a[1][p] = s.yy, a[2][p] = s.zz, a[3][p] = s.xy, a[4][p] = s.xz, a[5][p] = s.yz;
  }
};

/// State of the points of one block, from its first.
struct PointState
{
  double* __restrict c[6];
  double* __restrict plastic_strain;
  double* __restrict plastic_work;
  double* __restrict energy;
  const double* __restrict volume;

  GRANULAW_MEMBER PointState(SpatialBody& body, int first)
      : c{body.c_p[0].data() + first, body.c_p[1].data() + first, body.c_p[2].data() + first,
          body.c_p[3].data() + first, body.c_p[4].data() + first, body.c_p[5].data() + first},
        plastic_strain(body.plastic_strain_p.data() + first),
        plastic_work(body.plastic_work_p.data() + first),
        energy(body.elastic_energy_p.data() + first),
        volume(body.volume_p.data() + first)
  {
  }
};

/// F = 1 + h, its adjugate F^-1 det F, and its determinant.
struct Deformation
{
  double f[3][3], adjugate[3][3], determinant;
};

GRANULAW_INLINE Deformation deformation(const Block& block, int p)
{
  Deformation d;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) d.f[i][j] = block.h[3 * i + j][p] + (i == j ? 1.0 : 0.0);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
      d.adjugate[j][i] = d.f[a][c] * d.f[b][e] - d.f[a][e] * d.f[b][c];
    }
  d.determinant = d.f[0][0] * d.adjugate[0][0] + d.f[0][1] * d.adjugate[1][0] + d.f[0][2] * d.adjugate[2][0];
  return d;
}

/// a s a^T
GRANULAW_INLINE Symmetric pushed(const double (&a)[3][3], const Symmetric& s)
{
  double t[3][3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    t[i][0] = a[i][0] * s.xx + a[i][1] * s.xy + a[i][2] * s.xz;
    t[i][1] = a[i][0] * s.xy + a[i][1] * s.yy + a[i][2] * s.yz;
    t[i][2] = a[i][0] * s.xz + a[i][1] * s.yz + a[i][2] * s.zz;
  }
  const auto entry = [&](int i, int j) __attribute__((always_inline))
  {
    return t[i][0] * a[j][0] + t[i][1] * a[j][1] + t[i][2] * a[j][2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

/// Trial state of a point: x = F C_p^-1 F^T - 1 = h + h^T + h h^T + F c F^T, and its logarithmic strain.
template <bool has_state, bool yields>
GRANULAW_INLINE void trial_point(const Block& block, const PointState& state, int p, double shear2,
                                 Trials& out)
{
  const Deformation d = deformation(block, p);
  const auto h = [&](int i, int j) __attribute__((always_inline))
  {
    return block.h[3 * i + j][p];
  };
  const auto entry = [&](int i, int j) __attribute__((always_inline))
  {
    return h(i, j) + h(j, i) + h(i, 0) * h(j, 0) + h(i, 1) * h(j, 1) + h(i, 2) * h(j, 2);
  };
  Symmetric x{entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
  if constexpr (has_state) {
    const Symmetric c{state.c[0][p], state.c[1][p], state.c[2][p],
                      state.c[3][p], state.c[4][p], state.c[5][p]};
    const Symmetric y = pushed(d.f, c);
    x.xx += y.xx, x.yy += y.yy, x.zz += y.zz, x.xy += y.xy, x.xz += y.xz, x.yz += y.yz;
  }
  const LogarithmicStrain e = logarithmic_strain(x);
  Trials::write(out.deviator, p, e.deviator);
  out.trace[p] = e.trace;
  if constexpr (yields) {
    Trials::write(out.x, p, x);
    out.q[p] = shear2 * root_of(1.5 * square_of(e.deviator));
    out.jacobian[p] = d.determinant;  // plastic flow keeps the volume
  }
}

/// The point after its flow: plastic state, stored energy, first Piola-Kirchhoff stress P = tau F^-T.
template <bool flows>
GRANULAW_INLINE void finish_point(Block& block, const PointState& state, int p, const Trials& trials,
                                  double shear2, double bulk)
{
  const Deformation d = deformation(block, p);
  const double per_det = 1.0 / d.determinant, volume = state.volume[p];
  Symmetric e = Trials::read(trials.deviator, p);
  if constexpr (flows) {
    const double shrink = 1.5 * shear2 * trials.strain[p] / (trials.q[p] + 1e-300);
    // plastic state: b_new - b_trial = b_trial (exp(-2 shrink e) - 1), carried back through F
    const double by = -2.0 * shrink;
    const Symmetric change =
        exponential_m1({by * e.xx, by * e.yy, by * e.zz, by * e.xy, by * e.xz, by * e.yz});
    Symmetric b = Trials::read(trials.x, p);
    b.xx += 1.0, b.yy += 1.0, b.zz += 1.0;
    const Symmetric c = pushed(d.adjugate, product(b, change));
    const double per_det2 = per_det * per_det;
    state.c[0][p] += per_det2 * c.xx, state.c[1][p] += per_det2 * c.yy, state.c[2][p] += per_det2 * c.zz;
    state.c[3][p] += per_det2 * c.xy, state.c[4][p] += per_det2 * c.xz, state.c[5][p] += per_det2 * c.yz;
    state.plastic_strain[p] += trials.strain[p];
    state.plastic_work[p] += volume * trials.stress[p] * trials.strain[p];
    const double keep = 1.0 - shrink;
    e.xx *= keep, e.yy *= keep, e.zz *= keep, e.xy *= keep, e.xz *= keep, e.yz *= keep;
  }
  const double trace = trials.trace[p], pressure = bulk * trace;
  state.energy[p] = volume * 0.5 * (shear2 * square_of(e) + bulk * trace * trace);
  const double scale = volume * per_det;
  const double tau[3][3] = {{shear2 * e.xx + pressure, shear2 * e.xy, shear2 * e.xz},
                            {shear2 * e.xy, shear2 * e.yy + pressure, shear2 * e.yz},
                            {shear2 * e.xz, shear2 * e.yz, shear2 * e.zz + pressure}};
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j)
      block.h[3 * i + j][p] = scale * (tau[i][0] * d.adjugate[j][0] + tau[i][1] * d.adjugate[j][1] +
                                       tau[i][2] * d.adjugate[j][2]);
}

template <bool has_state, bool yields>
__attribute__((noinline)) void find_trials(const Block& block, const PointState state, int count,
                                           double shear2, Trials& trials)
{
#pragma omp simd
  for (int p = 0; p < count; ++p) trial_point<has_state, yields>(block, state, p, shear2, trials);
}

template <bool flows>
__attribute__((noinline)) void finish(Block& block, const PointState state, int count, const Trials& trials,
                                      double shear2, double bulk)
{
#pragma omp simd
  for (int p = 0; p < count; ++p) finish_point<flows>(block, state, p, trials, shear2, bulk);
}

/// Stress update of the points of one block: the equations of kernels_isa.cpp in three dimensions.
/// Multiplicative J2 plasticity with logarithmic elastic strain; yield on the Cauchy stress.
template <class Hardening, class Rate>
GRANULAW_INLINE void stress(SpatialBody& body, const Moduli& moduli, int first, int count, Block& block,
                            [[maybe_unused]] const Hardening hardening, [[maybe_unused]] const Rate rate)
{
  constexpr bool yields = !std::is_same_v<Hardening, Elastic> && !std::is_same_v<Hardening, ElasticWithState>;
  constexpr bool has_state = !std::is_same_v<Hardening, Elastic>;
  const double shear2 = 2.0 * moduli.shear;
  const PointState state(body, first);
  Trials trials;
  find_trials<has_state, yields>(block, state, count, shear2, trials);
  bool flows = false;
  if constexpr (yields)
    flows = find_flow(trials, count, static_cast<const double*>(state.plastic_strain), hardening, rate,
                      moduli, body.elapsed > 0.0 ? 1.0 / body.elapsed : 0.0);
  if (flows)
    finish<true>(block, state, count, trials, shear2, moduli.bulk);
  else
    finish<false>(block, state, count, trials, shear2, moduli.bulk);
}

/// One region under one pair of laws, block by block. A function of its own for each pair.
template <class Hardening, class Rate>
__attribute__((noinline)) void update_region(SpatialBody& body, const SpatialRegion& region,
                                             const Hardening hardening, const Rate rate)
{
  const Grid grid(body);
  Block block;
  for (int first = region.begin; first < region.end; first += block_cells) {
    const int end = first + block_cells < region.end ? first + block_cells : region.end;
    gather(grid, first, end, block);
    stress(body, region.moduli, octants * first, octants * (end - first), block, hardening, rate);
    scatter(grid, first, end, block);
  }
}

void internal_force(SpatialBody& body, bool frozen)
{
  double* __restrict f = body.f_i.data();
  for (int i = 0; i < 4 * body.nodes; ++i) f[i] = 0.0;
  for (const SpatialRegion& region : body.regions) {
    if (frozen && region.moduli.yields)
      update_region(body, region, ElasticWithState{}, no_rate);
    else if (!region.moduli.yields)
      update_region(body, region, Elastic{}, no_rate);
    else
      with_flow_laws(region.moduli,
                     [&](auto hardening, auto rate) { update_region(body, region, hardening, rate); });
  }
  if (!frozen) body.elapsed = 0.0;
}

void accelerate(SpatialBody& body, double dt)
{
  const double* __restrict w = body.inverse_mass_i.data();
  const double* __restrict f = body.f_i.data();
  double* __restrict v = body.v_i.data();
#pragma omp simd
  for (int i = 0; i < 4 * body.nodes; ++i) v[i] += dt * w[i] * f[i];
}

void move(SpatialBody& body, double dt)
{
  const double* __restrict v = body.v_i.data();
  double* __restrict u = body.u_i.data();
#pragma omp simd
  for (int i = 0; i < 4 * body.nodes; ++i) u[i] += dt * v[i];
  body.elapsed += dt;
}

/// Largest eigenvalue of a positive tensor, from above by less than 1 %: with equal smaller ones the first
/// estimate is exact (Smith 1961), elsewhere Newton's steps on the characteristic polynomial come down to it.
GRANULAW_INLINE double largest_eigenvalue(const Symmetric& a)
{
  const double mean = trace_of(a) * (1.0 / 3.0);
  const Symmetric d{a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.xz, a.yz};
  const double second = 0.5 * square_of(d), third = determinant_of(d);
  double x = 2.0 * root_of(second * (1.0 / 3.0));
#pragma GCC unroll 3
  for (int n = 0; n < 3; ++n) {
    const double slope = 3.0 * x * x - second;
    x -= (x * (x * x - second) - third) / (slope + 1e-300);
  }
  return mean + x;
}

/// Largest 1 + share (ratio - 1) and least det F of the octants of one cell, ratio the largest eigenvalue of
/// A A^T (CellGrowth) over `at_rest`.
GRANULAW_INLINE void measure_cell(const Block& block, int first, const double (&per_edge)[3], double at_rest,
                                  const double* __restrict share, double& largest, double& least_volume)
{
  double most = 0.0, least = 1.0;
#pragma omp simd reduction(max : most) reduction(min : least)
  for (int lane = 0; lane < octants; ++lane) {
    const Deformation d = deformation(block, first + lane);
    const double(&a)[3][3] = d.adjugate;
    const auto entry = [&](int i, int j) __attribute__((always_inline))
    {
      return per_edge[i] * per_edge[j] * (a[i][0] * a[j][0] + a[i][1] * a[j][1] + a[i][2] * a[j][2]);
    };
    const double found =
        largest_eigenvalue({entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)}) /
        (d.determinant * d.determinant * at_rest);
    const double counted = 1.0 + share[lane] * (found - 1.0);
    most = counted > most ? counted : most;
    // not a number counts as turned inside out
    least = d.determinant > least ? least : (d.determinant == d.determinant ? d.determinant : -1.0);
  }
  largest = most, least_volume = least;
}

CellGrowth growth(const SpatialBody& body)
{
  const Grid grid(const_cast<SpatialBody&>(body));  // reads only
  constexpr double whole[octants] = {1, 1, 1, 1, 1, 1, 1, 1};
  CellGrowth found{0.0, 1.0, 1.0, 1.0};
  const auto raise = [](double& most, double value) __attribute__((always_inline))
  {
    most = value > most ? value : most;
  };
  Block block;
  for (const SpatialRegion& region : body.regions)
    for (int first = region.begin; first < region.end; first += block_cells) {
      const int end = first + block_cells < region.end ? first + block_cells : region.end;
      gather(grid, first, end, block);
      for (int cell = first; cell < end; ++cell) {
        double per_edge[3], finest = 0.0, ratio, volume;
        for (int d = 0; d < 3; ++d) {
          per_edge[d] = grid.axis[d][grid.cells[cell].column[d]].per_edge;
          raise(finest, per_edge[d]);
        }
        const int cut = grid.cells[cell].cut;
        const double* share = cut >= 0 ? body.step_share_p.data() + octants * std::size_t(cut) : whole;
        measure_cell(block, octants * (cell - first), per_edge, finest * finest, share, ratio, volume);
        raise(found.largest, ratio);
        if (cut >= 0)
          raise(found.cut, ratio);
        else
          raise(found.filled_omega2, 1.5 * region.wave_speed2 * finest * finest * ratio);
        found.least_volume = volume < found.least_volume ? volume : found.least_volume;
      }
    }
  return found;
}

}  // namespace

extern const SpatialKernels spatial_kernels{GRANULAW_ISA_NAME, internal_force, accelerate, move, growth};

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
