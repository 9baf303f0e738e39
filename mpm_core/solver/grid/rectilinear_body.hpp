#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "solver/body/body.hpp"
#include "solver/grid/mapped_body.hpp"

namespace granulaw {

/// The meridian section of any body of revolution and the graded rectilinear grid over it, solver
/// units.
///
///     | | | |  |   |     |
///     +-+-+-+--+---+-----+--   steps grow upwards and outwards
///     +-+-+-+--+---+-----+--
///     +-+-+-+--+---+-----+--   fine over block x depth at the contact pole
///     ----------------------   plane
struct CutSection
{
  std::vector<Phase> phases;
  /// index of the phase at (r, z), -1: outside, or in a pore
  std::function<int(double r, double z)> phase_at;
  std::function<double(double r)> surface_z;            ///< height of the lower surface
  double radius = 1;                                    ///< largest distance from the axis
  double height = 2;                                    ///< top; the plane of symmetry under midplane support
  double mass = 0;                                      ///< exact, of what lies below `height`; 0: as sampled
  double block = 0.3, depth = 0.3;                      ///< extent of the fine steps
  double fine = 0.02;                                   ///< the fine step
  std::vector<std::pair<double, double>> pore_walls{};  ///< r, z, two opposite ones after each other
  /// nearest place inside the body, or where it is; empty: nothing will be drawn
  std::function<std::pair<double, double>(double r, double z)> onto_body;
  double shift = 0;  ///< part of a step that all lines r move towards the axis
};

/// Total-Lagrangian body on the rectilinear grid, quadratic B-splines (spline_axis.hpp).
///
/// Every cell is quartered; of each quarter, each phase that it holds makes one material point, whose volume,
/// masses and mean gradients are integrated over that piece: exactly where the quarter is whole, by 8 x 8
/// samples where the surface or an interface cuts it. Nodes near the surface keep the little mass that is
/// really theirs: with lumped masses their stiffness falls with it, so the time step stays, while a least
/// mass would make them lag behind (a tenth of the full one: 2 % of the energy of an elastic impact lost).
Body rectilinear_body(const CutSection& section);

/// The surface markers of a section, r, z only: `per_column` in each column of cells, and one at the pole.
/// A column has about one degree of freedom for the shape of its surface. With more markers the impulses are
/// not unique, the sweeps converge badly, and the contact feeds vibration (four a column: 24 % of the energy
/// of an elastic impact pumped in and out; one: 1e-5).
Markers section_markers(const CutSection& section, const SplineAxis& r_axis, int per_column);

/// One piece of the body that a material point stands for.
struct Piece
{
  int phase;
  double r, z;            ///< centroid
  double r0, r1, z0, z1;  ///< the quarter
  double volume;          ///< full revolution
  int r_first, z_first;
  /// means over the piece, [r function * 3 + z function]: N, dN/dr, dN/dz, N/r
  std::array<double, 9> n, br, bz, bh;
};

/// Regions of points made of pieces that are sorted by phase.
std::vector<Region> regions_of(const std::vector<Phase>& phases, const std::vector<Piece>& pieces);

/// All pieces of the section on these axes, in the order of their phases.
std::vector<Piece> cut_pieces(const CutSection& section, const SplineAxis& r_axis, const SplineAxis& z_axis);

}  // namespace granulaw
