#pragma once

#include "solver/contact/contact.hpp"

namespace granulaw {

/// Place and velocity of a surface point.
struct SurfaceMotion
{
  double r, z, vr, vz;
};
SurfaceMotion surface_motion(const Body& body, int marker);

/// What the first body's surface meets: the plane z = 0, or the second body's surface, a polyline through its surface points, found
/// by walking outwards.
class Opposite
{
 public:
  struct Place
  {
    double gap, approach, slope = 0;
    int segment = 0;
    double t = 0;  ///< place on the segment, 0 to 1
  };
  explicit Opposite(std::span<const Body> bodies);
  /// The place across a point; false: it lies beyond the other surface. To be asked from the pole outwards.
  bool find(const SurfaceMotion& point, Place& place);

 private:
  const Body* body_;  // null: the plane
  int segment_ = 0;
  SurfaceMotion inner_{}, outer_{};  // ends of the segment
};

/// Any surface of revolution against the rigid, frictionless plane z = 0 or against another body's surface, which
/// is described in its own frame: pole at the origin, mirrored, so that the gap is the sum of both heights.
/// Normals are those of the other surface.
class Surface : public Side
{
 public:
  explicit Surface(std::span<const Body> bodies);
  int add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
               ContactRow* rows) override;
  std::size_t most_rows() const override { return gap_.size(); }
  double finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double dt) override;
  double edge_radius(std::span<const Body> bodies) const override;
  void visit_state(StateArchive& archive) override;

 private:
  void set_far(const Body& lower, const Opposite::Place& other, ContactRow& row);

  AlignedVector<double> impulse_;     // [surface point][4], of the last step: where the sweeps start
  std::vector<double> gap_, radius_;  // per surface point, before the step
  std::vector<int> far_offset_;       // [marker][2 corners]
  std::vector<double> far_weight_;
  int outermost_ = -1;
};

}  // namespace granulaw
