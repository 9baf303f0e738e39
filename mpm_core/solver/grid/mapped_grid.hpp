#pragma once

#include <array>
#include <vector>

namespace granulaw {

/// The reference grid fitted to a sphere of radius 1 that touches the plane z = 0 at the origin.
///
/// A conformal map carries the half disc (the meridian section, r >= 0) to the quarter plane
///     zeta = (1 - w)/(1 + w),    w the disc coordinate, contact pole at w = 1, i.e. zeta = 0,
/// where |zeta| = 1 is the mid-plane and the surface is the imaginary axis. In that plane the grid is a
/// rounded square of N x N cells about the contact pole ("block") and rings of 2 N cells around it whose
/// spacing grows in proportion to the distance from the pole: the far field is almost free.
/// Beyond the mid-plane (full sphere) coarser rings and a large block close the far side.
///
///        ___
///      /     \        far block, coarse
///     |-------|       |zeta| = 1
///      \  _  /        rings
///       \[#]/         block, N x N
///     ----+----  plane
struct MappedGrid
{
  struct Node
  {
    double r, z;
  };
  std::vector<Node> nodes;
  std::vector<std::array<int, 4>> cells;  ///< corner nodes, counter-clockwise in (r, z)
  std::vector<int> surface;               ///< nodes on the lower half's surface, from the pole outwards
  std::vector<int> axis;                  ///< nodes with r = 0
  std::vector<int> equator;               ///< nodes of the mid-plane; driven under midplane support
  double volume = 0;                      ///< exact, full revolution

  /// `cells_across` N >= 4; `block` = radius the block covers on the surface, in units of R, up to 0.9;
  /// `full` = whole sphere, else the lower half up to the mid-plane.
  /// `shift` moves the block's grid lines towards the pole by that part of a cell: runs at different shifts
  /// meet the contact edge at different phases, and their mean is free of the grid noise's lower harmonics.
  static MappedGrid build(int cells_across, double block, bool full, double shift = 0);

  /// A deformable wall: half a ball of radius `extent` with its flat side, z = 0, in contact; the same block
  /// and rings without the conformal map. Its far side is free: a wave needs 2 extent/c to come back.
  static MappedGrid wall(int cells_across, double block, double extent, double shift = 0);

  /// The same grid of a body `factor` times as large.
  void scale(double factor);
};

}  // namespace granulaw
