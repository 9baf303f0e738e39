#pragma once

#include <array>
#include <functional>
#include <vector>

namespace granulaw {

/// The body at one moment, SI. Axisymmetric section (r, z): the plane is z = 0, the axis r = 0. In three
/// dimensions r stands for x, and y is filled.
struct FieldFrame
{
  double time = 0;   ///< s since first touch
  double delta = 0;  ///< m, overlap at `time`, of this grid (the trace holds the mean of all shifted grids)
  double force = 0;  ///< N, mean over the trace sample that ends at `time`, of this grid
  // at the nodes
  std::vector<double> r, z;       ///< m, where the nodes are now
  std::vector<double> ur, uz;     ///< m, displacement
  std::vector<double> vr, vz;     ///< m/s
  std::vector<double> y, uy, vy;  ///< three dimensions only
  // in the cells (one material point each; in three dimensions means over eight)
  std::vector<double> plastic_strain;  ///< equivalent plastic strain
  std::vector<double>
      pressure;  ///< Pa, minus a third of the trace of the Cauchy stress: compression positive
  std::vector<double> von_mises;     ///< Pa, of the Cauchy stress
  std::vector<double> axial_stress;  ///< Pa, zz component of the Cauchy stress: tension positive; in the
                                     ///< cells at the plane it is minus the contact pressure
};

/// Who wants to see the body while a run goes on. Of the shifted grids only one is shown: the one with the
/// shift nearest to zero (four grids: the unshifted one). The solver contains no file handling.
struct FieldObserver
{
  int frames =
      40;  ///< about so many, equally spaced in time; the first is the undeformed body, the last the end
  /// Called once before the frames of a run: corner nodes of each cell, counter-clockwise in (r, z).
  std::function<void(int nodes, const std::vector<std::array<int, 4>>& cells)> begin;
  /// The same in three dimensions: hexahedra, the lower four corners and the upper four, each
  /// counter-clockwise.
  std::function<void(int nodes, const std::vector<std::array<int, 8>>& cells)> begin_solid;
  std::function<void(const FieldFrame&)> frame;  ///< may throw to stop the run

  explicit operator bool() const { return static_cast<bool>(frame); }
};

}  // namespace granulaw
