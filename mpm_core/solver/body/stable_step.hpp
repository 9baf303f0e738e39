#pragma once

#include "solver/body/body.hpp"

namespace granulaw {

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
  double omega_ = 0;
};

}  // namespace granulaw
