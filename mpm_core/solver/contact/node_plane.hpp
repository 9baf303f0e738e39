#pragma once

#include "solver/contact/contact.hpp"

namespace granulaw {

/// The rigid, frictionless plane z = 0 against a body whose surface points are grid nodes:
/// predictor-corrector. A node that would end the step below the plane gets the velocity that puts it there;
/// the nodes do not disturb each other. Nodes inside the body are held above the plane as well: from about
/// 0.2 R on, a cell at the edge of the contact can be sheared so far that its inner nodes pass its own
/// surface, which one point a cell does not see, and the body would run through the plane there (E*/Y = 100,
/// V/V_y = 3000: e .085, .097, .116 at 10, 14, 20 cells, instead of .070, .074, .078 towards .08).
class NodePlane : public Contact
{
 public:
  using Contact::Contact;
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

  std::vector<Push> pushes_;
  double impulse_ = 0;
  int outermost_ = -1;  // index into the surface
};

}  // namespace granulaw
