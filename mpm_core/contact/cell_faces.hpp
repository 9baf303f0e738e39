#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/vector.hpp"

namespace granulaw {

/// A ball about the origin that planes cut, exactly: each face is a disc that the other planes cut. Planes are n.x <= d, n a unit
/// vector that points outward. Lengths in the caller's unit. No allocation once it served as many planes.
class CellFaces
{
 public:
  struct Sums
  {
    double free_share;  ///< psi: solid angle of the sphere's surface that no plane cuts, over 4 pi
    double volume;      ///< of the cut ball
  };

  /// Takes the planes' directions, for any number of cuts().
  void set_directions(std::span<const Vector> normals);
  /// Areas of the faces, and their sums. `heights`: d of each plane, may be negative; `radius`: of the ball, > 0.
  Sums cut(std::span<const double> heights, double radius, std::span<double> areas);
  double cosine(std::size_t i, std::size_t j) const { return of_[i * size_ + j].cosine; }

 private:
  struct Other  // plane i as it stands to plane j: of_[j * size_ + i]
  {
    double cosine, sine, azimuth;  // azimuth in the plane j; worked out where i cuts the face of j
  };
  struct Edge
  {
    double distance, half_length, begin, end, azimuth;  // of a line in the face's plane
  };
  struct Interval
  {
    double begin, end;
  };
  double azimuth(std::size_t i, std::size_t j);
  bool cut_face(std::size_t j, std::span<const double> heights, double radius);
  double covered();
  double solid_angle_and_area(double height, double& area);

  std::size_t size_ = 0;
  std::vector<Other> of_;
  std::vector<Vector> normals_, first_, second_;  // axes of each plane
  std::vector<Edge> edges_;
  std::vector<Interval> intervals_;
};

}  // namespace granulaw
