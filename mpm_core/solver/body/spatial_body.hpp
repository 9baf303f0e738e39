#pragma once

#include <array>
#include <vector>

#include "solver/body/spline_axis.hpp"
#include "solver/material/moduli.hpp"
#include "solver/body/aligned_vector.hpp"

namespace granulaw {

class StateArchive;

/// Octants of a cell: the lanes of the kernels. Octant 4 x + 2 y + z, each 0 in the lower half of the cell
/// and 1 in the upper one.
inline constexpr int octants = 8;
/// Nodes whose quadratic splines reach into a cell: 3 x 3 x 3, node 9 x + 3 y + z of a cell.
inline constexpr int cell_nodes = 27;

/// Means of the three splines of an axis and of their slopes over both halves of one cell, one entry for each
/// octant.
template <class Real>
struct alignas(64) AxisWeights
{
  Real n[3][octants], dn[3][octants];
  Real per_edge;     ///< 1/h, h the edge of the cell
  Real left, right;  ///< h over itself and the cell before, or behind: with xi = x/h from the middle of the
                     ///< cell the outer splines are left (xi - 1/2)^2 and right (xi + 1/2)^2
};

/// A cell with the one material that its points are made of: a cell across an interface occurs once for each
/// of its materials.
struct SpatialCell
{
  int node;                   ///< the lowest of its nodes; the others follow by the strides of the grid
  std::array<int, 3> column;  ///< its index along x, y, z
  int cut;                    ///< place in cut_moments; -1: the whole cell is of this material
  /// Cut cells: on each axis t = 1/2 + along x/h from the middle of the cell, so that the material lies at
  /// small t. The nodes that it hardly reaches have powers of t for weights, exact to rounding also in float.
  std::array<int, 3> along{1, 1, 1};
};

/// Cells [begin, end) of one material.
struct SpatialRegion
{
  int begin, end;
  Moduli moduli;
  int material = 0;        ///< index in the particle's list
  double wave_speed2 = 1;  ///< square of that of pressure waves
};

/// Points of the true surface, where planes push: place, cell nodes and their weights.
struct SpatialSurface
{
  int count = 0;
  std::vector<std::array<double, 3>> place;  ///< on the reference surface
  std::vector<int> node;                     ///< lowest node of the cell that each lies in
  std::vector<double> weight;                ///< [count][cell_nodes]
  std::vector<double> area;                  ///< of the patch of the surface that each stands for
  double finest = 0;                         ///< shortest edge of a cell with a marker
};

/// A vector at each node: x, y, z and a zero, so that a node is one access. Entry 4 node + component.
using NodeField = AlignedVector<double>;

/// Moments of a piece that the kernels read: means over the piece of l(t_x) m(t_y) n(t_z), l, m, n each one
/// of 1, t, t^2/2 of the cell's own coordinates (SpatialCell::along, 0 to 1); number 9 l + 3 m + n, all but
/// the last of 27.
inline constexpr int cut_moments_each = 26;

/// What the material points of a three-dimensional body carry, and their weights.
template <class Real>
struct SpatialPoints
{
  std::array<std::vector<AxisWeights<Real>>, 3> axis_weights;
  AlignedVector<Real> cut_moments;  ///< [cut cell][cut_moments_each][octant]
  AlignedVector<Real> volume_p;     ///< reference volume, 0: nothing there
  /// plastic state: inverse plastic right Cauchy-Green tensor minus identity, xx yy zz xy xz yz
  std::array<AlignedVector<Real>, 6> c_p;
  AlignedVector<Real> plastic_strain_p, plastic_work_p, elastic_energy_p;
};

/// A three-dimensional body on its graded rectilinear grid, structure of arrays, solver units (E* = rho = 1).
/// Total Lagrangian: weights are computed once on the reference grid, nodal displacements are kept.
///
/// Quadratic B-splines over three axes; node (i, j, k) is (k count_y + j) count_x + i, and nodes that no part
/// of the body reaches have no mass. Each octant of a cell is a material point (lane p = 8 cell + octant).
/// Its weights are the means of the splines' gradients over the piece of the body in the octant: linear
/// displacement fields, uniform stress, momentum and angular momentum are exact (Flanagan and Belytschko
/// 1981). In a cell that is filled they are products of the axes' own means. Within a cell every spline is a
/// polynomial, so a cut piece needs its moments only: a third of the memory of its 81 weights.
struct SpatialBody : SpatialPoints<double>
{
  // grid
  std::array<SplineAxis, 3> axes;
  std::array<int, 3> count{};  ///< functions along each axis
  int nodes = 0;
  std::vector<double> mass_i;
  NodeField inverse_mass_i;  ///< zero in a direction in which a symmetry plane holds the node
  NodeField u_i, v_i, f_i;   ///< displacement, velocity, internal force
  /// the body is one half, quarter or eighth: it is mirrored at the lower end of these axes
  std::array<bool, 3> mirrored{};
  double mass = 0;                 ///< of the part that is computed
  std::array<double, 3> travel{};  ///< displacement of its centre of mass, integrated from the momentum
  SpatialSurface surface;
  /// for looking at: corners of the cells, moved onto the surface where they lie outside, and each cell's
  /// eight
  SpatialSurface corners;
  std::vector<std::array<int, 8>> drawn_cells;

  // material points
  std::vector<SpatialCell> cells;
  std::vector<SpatialRegion> regions;
  int points = 0;  ///< octants that hold material; a cell has eight lanes whatever it holds
  /// [cut cell][octant]: stiffness of a cut piece over the masses of its nodes, as a share of a filled
  /// octant's. If the piece's own omega^2 grows by x, the body's highest grows by at most share times x
  /// (Weyl's inequality).
  AlignedVector<double> step_share_p;
  double elapsed = 0;  ///< time since the plastic state was last updated

  /// Single precision: weights and state of the points in float, used instead of the double ones where
  /// filled. Nodes stay double, and so do the equations of flow laws without a closed form. `fetch_state`
  /// copies the state back.
  SpatialPoints<float> single;
  bool is_single() const { return !single.volume_p.empty(); }
  void use_single();
  void fetch_state();

  std::array<int, 3> strides() const { return {1, count[0], count[0] * count[1]}; }
  /// How many of these parts make the whole body.
  int copies() const;

  void allocate_nodes();
  void allocate_points();

  double kinetic_energy() const;
  double strain_energy() const;
  double plastic_work() const;
  double hourglass_energy() const { return 0; }  ///< eight points a cell need no hourglass control
  double largest_plastic_strain() const;

  void visit_state(StateArchive& archive);
};

}  // namespace granulaw
