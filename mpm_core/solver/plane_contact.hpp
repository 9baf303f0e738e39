#pragma once

#include "solver/body.hpp"

namespace granulaw {

/// Contact of the body's surface nodes with the rigid, frictionless plane z = 0.
///
/// Predictor-corrector: a node that would end the step below the plane gets the velocity that puts it on the
/// plane, and the plane gets the impulse that this takes. No stiffness, no gap, no iteration; the force can
/// only push. State is one number, the edge of the contact, kept for output.
class PlaneContact
{
 public:
  /// Corrects velocities of the surface nodes for a step `dt`; returns the impulse of the plane on the body
  /// (+z).
  double correct(Body& body, double dt);

  /// Radius of the contact edge after the last correct(), 0 if open: where the gap, extrapolated from the
  /// first two open nodes as (r - a)^1.5 beside the last closed node, vanishes.
  double edge_radius(const Body& body) const;

 private:
  int outermost_ = -1;  // index into body.surface
};

}  // namespace granulaw
