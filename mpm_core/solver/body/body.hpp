#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "solver/body/node_field.hpp"
#include "solver/body/spline_axis.hpp"
#include "solver/material/moduli.hpp"

namespace granulaw {

class StateArchive;

/// Points of the one material that lie in [begin, end).
struct Region
{
  int begin, end;
  Moduli moduli;
  int material = 0;        ///< index in the particle's list
  double wave_speed2 = 1;  ///< three dimensions: square of that of pressure waves
};

/// Places that move with a body, each carried by `corners` nodes: on a surface where contact is looked for,
/// on the walls of pores, or of a drawing. On a grid fitted to the body a place is a node itself (one
/// corner).
struct Markers
{
  int count = 0, corners = 0;
  std::vector<std::array<double, 3>> place;  ///< in the reference body (`updated`: now); r along x
  std::vector<int> lowest;                   ///< node from which a marker's offsets count
  std::vector<int> offset;                   ///< [count][corners], or [corners] for all of them
  std::vector<double> weight;                ///< [count][corners]
  std::vector<double> area;                  ///< three dimensions: of the patch that each stands for
  double finest = 0;                         ///< three dimensions: shortest edge of a cell with a marker

  const int* offsets(int m) const
  {
    return offset.data() + (offset.size() == std::size_t(corners) ? 0 : std::size_t(m) * corners);
  }
  const double* weights(int m) const { return weight.data() + std::size_t(m) * corners; }
  int node(int m, int k) const { return lowest[m] + offsets(m)[k]; }
};

/// Nodes and weights of markers of a body of revolution, which stand at their places on a grid of these axes.
void weigh_markers(Markers& markers, const SplineAxis& r_axis, const SplineAxis& z_axis);

/// Weights of points that exchange with the nodes of their corners, [corner * points + p]: d/dr, d/dz and
/// hoop (N/r); four corners: also hourglass shape vector and stiffness.
template <class Real>
struct CornerWeights
{
  AlignedVector<Real> br, bz, bh, hourglass, stiffness;
};

/// Points of a body of revolution and their nodes.
struct Corners
{
  int each = 0;                 ///< corners of a point: 4 or 9
  std::vector<int> node;        ///< [corner * points + p]
  int slots = 0;                ///< most corners that meet in a node, rounded up to a multiple of 4
  std::vector<int> node_slots;  ///< [slots][nodes] positions in corner_f*; unused ones point at a zero
  CornerWeights<double> full;
  CornerWeights<float> single;
  double bound_at_rest =
      0;  ///< largest of the points' bounds on omega^2, undeformed (Growth); 0: not yet known
};

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

/// Moments of a piece that the kernels read: means over the piece of l(t_x) m(t_y) n(t_z), l, m, n each one
/// of 1, t, t^2/2 of the cell's own coordinates (SpatialCell::along, 0 to 1); number 9 l + 3 m + n, all but
/// the last of 27.
inline constexpr int cut_moments_each = 26;

template <class Real>
struct CellWeights
{
  std::array<std::vector<AxisWeights<Real>>, 3> axis;
  AlignedVector<Real> cut_moments;  ///< [cut cell][cut_moments_each][octant]
};

/// Cells of a three-dimensional body: quadratic B-splines over three axes; node (i, j, k) is
/// (k count_y + j) count_x + i, and nodes that no part of the body reaches have no mass. Each octant of a
/// cell is a material point (p = 8 cell + octant). Its weights are the means of the splines' gradients over
/// the piece of the body in the octant: linear displacement fields, uniform stress, momentum and angular
/// momentum are exact (Flanagan and Belytschko 1981). In a cell that is filled they are products of the axes'
/// own means. Within a cell every spline is a polynomial, so a cut piece needs its moments only: a third of
/// the memory of its 81 weights.
struct SplineCells
{
  std::array<SplineAxis, 3> axes;
  std::array<int, 3> count{};  ///< functions along each axis
  std::vector<SpatialCell> cells;
  CellWeights<double> full;
  CellWeights<float> single;
  /// [cut cell][octant]: stiffness of a cut piece over the masses of its nodes, as a fraction of a filled
  /// octant's. If the piece's own omega^2 grows by x, the body's highest grows by at most share times x
  /// (Weyl's inequality).
  AlignedVector<double> step_share;
  std::vector<std::array<int, 8>> drawn;  ///< of each cell its eight corners in Reference::drawn

  std::array<int, 3> strides() const { return {1, count[0], count[0] * count[1]}; }
};

/// A body as it was built: grid, masses, weights. Bodies share it, for it does not change; on the `updated`
/// grid each has its own, which follows the points (MovingPoints). Fields of the points end in _p, of the
/// nodes in _i, as in the MPM literature.
///
/// Total Lagrangian: weights are computed once on the reference grid, nodal displacements are kept. The
/// weights of a point are the mean gradients of the shape functions over the piece of the body that it stands
/// for (of revolution: with r dA as measure), so that linear displacement fields and uniform pressure are
/// exact (Flanagan and Belytschko 1981).
struct Reference
{
  int nodes = 0;
  int points = 0;  ///< length of the points' fields
  int filled = 0;  ///< points that hold material: of three dimensions the octants with a volume
  std::vector<double> mass_i;
  NodeField place_i;
  NodeField inverse_mass_i;        ///< 0 where the axis or a mirror holds a node, or where it has no mass
  AlignedVector<double> volume_p;  ///< full revolution; 0: nothing there
  AlignedVector<float> single_volume_p;
  std::vector<Region> regions;  ///< by material, in the order of the points
  std::vector<int> equator;     ///< nodes of the plane driven under midplane support
  Markers surface;              ///< true surface: of revolution from the contact pole outwards
  Markers pore_walls;           ///< pairs of places on opposite walls of a pore, one after the other
  Markers drawn;                ///< for looking at: corners of pieces ([4][points]) or of cells
  std::array<bool, 3>
      mirrored{};     ///< the body is a half, quarter or eighth, mirrored at these axes' lower end
  double mass = 0;    ///< of the part that is computed
  Corners corners;    ///< bodies of revolution
  SplineCells cells;  ///< three dimensions

  bool is_spatial() const { return !cells.cells.empty(); }
  /// Number of these parts that make the whole body.
  int copies() const { return (mirrored[0] ? 2 : 1) * (mirrored[1] ? 2 : 1) * (mirrored[2] ? 2 : 1); }
  void resize_nodes(int count, int components);
  /// Body of revolution: room for points of `each` corners.
  void resize_corners(int count, int each);
  /// Body of revolution: fills node_slots and, but on the axis, inverse masses, once corners and masses
  /// stand.
  void link(const std::vector<int>& axis);
};

/// State of the material points, structure of arrays.
template <class Real>
struct PointState
{
  /// inverse plastic right Cauchy-Green tensor minus identity (`updated`: elastic left Cauchy-Green tensor
  /// minus identity): rr zz rz hoop, or xx yy zz xy xz yz
  std::vector<AlignedVector<Real>> c_p;
  AlignedVector<Real> plastic_strain_p;      ///< equivalent
  AlignedVector<Real> plastic_work_p;        ///< dissipated, per point
  AlignedVector<Real> elastic_energy_p;      ///< stored, per point, written with every stress evaluation
  AlignedVector<Real> corner_fr, corner_fz;  ///< scratch: forces on the corners, the last entry is a zero
};

/// The points of a body on the `updated` grid, which move through it (updated_body.hpp).
struct MovingPoints
{
  SplineAxis r_axis, z_axis;
  std::vector<double> r, z;  ///< where they are
  std::vector<double> mass;
  std::vector<double> vr, vz;              ///< velocity
  std::vector<double> crr, crz, czr, czz;  ///< affine velocity: gradient of v about the point (APIC)
  std::vector<double> trr, tzz, trz, thh;  ///< Kirchhoff stress
  Reference own;                           ///< masses and weights of this step
};

/// A body on its grid, solver units (E* = rho = 1). Of revolution: in its own frame, contact pole at the
/// origin, body in z >= 0.
struct Body
{
  std::shared_ptr<const Reference> shared;
  std::optional<MovingPoints> moving;  ///< on the `updated` grid only: the displacements are the last step's
  NodeField u_i, v_i,
      f_i;  ///< displacement (never position: keeps small strains exact), velocity, internal force
  std::array<double, 3> travel{};  ///< displacement of the centre of mass, integrated from the momentum
  double elapsed = 0;              ///< time since the plastic state was last updated
  PointState<double> state;
  /// Single precision: state of the points in float, used instead of the double one where filled, with the
  /// weights in float. Nodes stay double, and so do the equations of flow laws without a closed form. Not on
  /// the `updated` grid. `fetch_state` copies the state back.
  PointState<float> single;

  Body() = default;
  /// At rest.
  explicit Body(Reference built);

  GRANULAW_MEMBER const Reference& reference() const { return moving ? moving->own : *shared; }
  int nodes() const { return reference().nodes; }
  int points() const { return reference().points; }
  double mass() const { return reference().mass; }
  bool is_single() const { return !single.plastic_strain_p.empty(); }
  void use_single();
  void fetch_state();

  double kinetic_energy() const;
  double strain_energy() const;  ///< elastic and hourglass energy at the last stress evaluation
  /// Part of the strain energy: of the hourglass control at the displacements now.
  double hourglass_energy() const;
  double plastic_work() const;
  double largest_plastic_strain() const;

  /// State that changes from step to step, and the reference grid as a thing to agree upon
  /// (state_archive.hpp).
  void visit_state(StateArchive& archive);
};

}  // namespace granulaw
