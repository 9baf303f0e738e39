#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/body/spline_axis.hpp"
#include "solver/grid/spatial_grid.hpp"

namespace granulaw {

/// The three splines that reach into a cell as polynomials of xi = (x - middle)/edge, -1/2 to 1/2.
struct CellSplines
{
  double middle, edge;
  double left, right;  ///< as in AxisWeights
  double n[3][3];      ///< spline, power

  CellSplines(const SplineAxis& axis, int cell);
};

/// Integrals of xi^l eta^m zeta^n, l, m, n up to 2, over a piece of a cell or of its surface; in units of the
/// cell's volume, or as they are.
class Moments
{
 public:
  double value[27]{};

  double size() const { return value[0]; }
  /// Adds a point of the cell with its weight.
  void add_point(const Vector3& x, double weight);
  /// Adds a box at `centre` with `edges`, both in the cell's coordinates.
  void add_box(const Vector3& centre, const Vector3& edges);
  /// Mean of the product of three polynomials, one in each coordinate, times size().
  double of(const double (&x)[3], const double (&y)[3], const double (&z)[3]) const;
};

/// Content of an octant: pieces of each phase, and its patch of the outer surface.
struct OctantContent
{
  std::vector<Moments> phases;
  Moments patch;  ///< size(): its area
};

/// Cuts the octants of one cell. An octant that the surface passes is halved twice along each axis. A small
/// box that the surface passes falls into six tetrahedra (Kuhn 1960), in which the signed distance is taken
/// as linear between their corners: neighbours see the same facets, so that the pieces of all cells fit
/// together and Gauss's theorem holds between them and the patches.
class CellCutter
{
 public:
  CellCutter(const SpatialSection& section, const std::array<const CellSplines*, 3>& splines);

  /// The phase that fills the whole cell; -1: it lies outside, -2: neither.
  int whole_phase() const;

  OctantContent octant(int k);

 private:
  static constexpr int levels = 2;           ///< halvings of an octant that is cut
  static constexpr int boxes = 1 << levels;  ///< along each edge of the octant then
  using Corner = std::array<int, 3>;         ///< of the lattice of small boxes, 0 to `boxes` each

  int phase_of_whole(const Vector3& x, double reach) const;
  void divide(const Corner& low, int edge);
  void cut_box(const Corner& low, const Vector3& middle);
  void cut_tetrahedron(const std::array<Corner, 4>& corners, Moments& piece);
  void add_tetrahedron(const std::array<Vector3, 4>& corners, Moments& piece) const;
  void add_facet(const std::array<Vector3, 3>& corners);
  Vector3 place(const Vector3& cell) const { return middle_ + cell.cwiseProduct(edge_); }
  Vector3 cell_place(const Corner& corner) const;
  double depth_at(const Corner& corner);

  const SpatialSection& section_;
  Vector3 middle_, edge_;
  Vector3 base_;  ///< lowest corner of the octant, in the cell's coordinates
  std::array<double, (boxes + 1) * (boxes + 1) * (boxes + 1)> depth_;  ///< at the lattice; NaN: not yet asked
  OctantContent content_;
};

}  // namespace granulaw
