#pragma once

#include "solver/body.hpp"
#include "solver/drive.hpp"
#include "solver/plane_contact.hpp"

namespace granulaw {

/// One step of the material point method on the reference grid, as verbs in order.
/// Returns the impulse that the plane gave the body (+z).
double advance(Body& body, PlaneContact& contact, Drive& drive, double time, double dt);

/// Largest stable step 2/omega_max of the central-difference scheme.
class StableStep
{
 public:
  /// omega_max of the undeformed body by power iteration on M^-1 K. The body must be undeformed and at rest.
  explicit StableStep(Body& body);
  /// The limit for the body as it is deformed now: omega_max scaled by the largest growth of any cell's own
  /// bound.
  double limit(const Body& body) const;

 private:
  double omega_ = 0, bound_ = 0;
};

}  // namespace granulaw
