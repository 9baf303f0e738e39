#pragma once

#include "base/attraction.hpp"
#include "solver/contact/contact.hpp"

namespace granulaw {

/// The rigid, frictionless plane z = 0 against a body whose surface points are grid nodes:
/// predictor-corrector. A node that would end the step below the plane gets the velocity that puts it there;
/// the nodes do not disturb each other. Nodes inside the body are held above the plane as well: from about
/// 0.2 R on, a cell at the edge of the contact can be sheared so far that its inner nodes pass its own
/// surface, which one point a cell does not see, and the body would run through the plane there (E*/Y = 100,
/// V/V_y = 3000: e .085, .097, .116 at 10, 14, 20 cells, instead of .070, .074, .078 towards .08).
///
/// Attraction pulls the nodes of the surface by sigma_0 (1 - g/h_0) times the area of their ring now, g their gap.
class NodePlane : public Contact
{
 public:
  NodePlane() = default;
  /// In units of the run.
  explicit NodePlane(const Attraction& attraction) : attraction_(attraction) {}
  double attracted() const override { return attracted_; }
  double correct(std::span<Body> bodies, double kick, double dt) override;
  void account(std::span<const Body> bodies) override;
  double edge_radius(std::span<const Body> bodies) const override;
  void visit_state(StateArchive& archive) override;

 private:
  struct Push
  {
    int node;
    double impulse, before;  // velocity at the start of the step
  };
  void push(Body& body, int node, double kick, double least);
  void pull(Body& body, double kick);

  Attraction attraction_;
  std::vector<Push> pushes_, pulls_;
  std::vector<double> pulled_;  // m/s, of each node in this step
  double attracted_ = 0;
  double impulse_ = 0;
  int outermost_ = -1;  // index into the surface
};

}  // namespace granulaw
