#pragma once

#include "solver/contact/contact.hpp"

namespace granulaw {

/// Any surface of revolution against the rigid, frictionless plane z = 0 or against another body's surface (a
/// polyline through its surface points), which is described in its own frame: pole at the origin, mirrored,
/// so that the gap is the sum of both heights. Normals are those of the other surface.
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
  /// The other surface across a marker.
  struct Across
  {
    double gap, approach, slope = 0;
    int segment = 0;
    double t = 0;  ///< place on the segment, 0 to 1
  };
  void set_far(const Body& lower, const Across& other, ContactRow& row);

  AlignedVector<double> impulse_;     // [surface point][4], of the last step: where the sweeps start
  std::vector<double> gap_, radius_;  // per surface point, before the step
  std::vector<int> far_offset_;       // [marker][2 corners]
  std::vector<double> far_weight_;
  int outermost_ = -1;
};

}  // namespace granulaw
