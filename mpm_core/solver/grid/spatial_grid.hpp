#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "solver/body/motion.hpp"
#include "solver/material/moduli.hpp"

namespace granulaw {

/// A three-dimensional body and the lines of its grid, solver units. Functions are asked at set-up only.
struct SpatialSection
{
  std::vector<Phase> phases;
  /// Signed distance to the outer surface, positive inside, and the unit vector out of the body.
  std::function<double(const Vector3&)> depth;
  std::function<Vector3(const Vector3&)> normal;
  /// Phases of a body of several materials: index of the phase at a place inside the outer surface (-1: a
  /// pore), and the distance from there to the nearest interface. Empty: phase 0 everywhere.
  std::function<int(const Vector3&)> phase_at{};
  std::function<double(const Vector3&)> interface_distance{};
  std::array<std::vector<double>, 3> lines;
  std::array<bool, 3> mirrored{};  ///< a symmetry plane at the first line of the axis
  bool drawn = false;              ///< corners of the cells are wanted
  double mass = 0;                 ///< exact, of the part on the grid; 0: as sampled
};

/// The body at rest. Cells are cut by the surface and by interfaces as a CutSection's are
/// (rectilinear_body.hpp). Cut octants fall into tetrahedra, in which the depth is linear (cell_cutter.hpp).
Body spatial_body(const SpatialSection& section);

/// Finest edge wanted about a place where planes push, and how far the fine cells reach from it along an
/// axis.
struct FineZone
{
  double low, high;  ///< fine between these
  double edge;
  double growth;  ///< an edge gains this fraction of its way from the zone
};

/// Lines of one axis over [low, high]: edges `edge` in the zones, growing away from them up to
/// `coarsest`, all moved by `shift` of a cell. `mirrored`: the first line stands at `low`, else the lines
/// reach beyond both ends.
std::vector<double> graded_axis(double low, double high, const std::vector<FineZone>& zones, double coarsest,
                                double shift, bool mirrored);

}  // namespace granulaw
