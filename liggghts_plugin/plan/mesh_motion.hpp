#pragma once

#include <array>
#include <map>
#include <vector>

#include "base/box.hpp"

namespace granulaw::plugin::plan {

/// Triangles of a mesh in motion, and how fast they push: whatever touches a mesh touches a face, an edge or a
/// corner of it, and is pushed along the line of centres alone. A drum that turns about its axis drags.
class MeshMotion
{
 public:
  using Triangle = std::array<Box::Point, 3>;

  /// Corners of the triangles, in the same order at each call, and the velocities of the corners. `upward`: against
  /// gravity, of length 1; 0 without gravity.
  void look(const std::vector<Triangle>& corners, const std::vector<Triangle>& velocities, const Box::Point& upward);

  // The largest so far.
  double speed() const { return speed_; }             ///< of a corner
  double push_speed() const { return push_; }         ///< along the line of a contact
  double level_push_speed() const { return level_; }  ///< the part of a face's push across gravity
  double lift() const { return lift_; }               ///< rise of a corner since it was lowest

 private:
  struct Edge
  {
    std::size_t a, corner, b;  ///< triangle, its corner where the edge begins, the other triangle (or none)
  };
  void connect(const std::vector<Triangle>& corners);
  void follow_rise(const std::vector<Triangle>& corners, const Box::Point& upward);
  void look_at_edges(const std::vector<Triangle>& corners, const std::vector<Triangle>& velocities);
  void look_at_vertices(const std::vector<Triangle>& corners, const std::vector<Triangle>& velocities);

  std::vector<std::array<std::size_t, 3>> vertices_;  // of each triangle
  std::size_t vertex_count_ = 0;
  std::vector<Edge> edges_;
  std::vector<std::array<double, 3>> lowest_;  // height of each corner
  double speed_ = 0, push_ = 0, level_ = 0, lift_ = 0;
};

}  // namespace granulaw::plugin::plan
