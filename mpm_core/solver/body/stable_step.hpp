#pragma once

#include <Eigen/Core>

#include "base/state_archive.hpp"
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

/// The same of a body in three dimensions, measured as it is deformed now: where one squeezed cell sets the
/// bound above, the measured limit is up to five times as long. Power iteration approaches the highest
/// frequency from below. It starts from the vector found last, which changes little.
class MeasuredStep
{
 public:
  /// `kept`: the same reference at rest, turned by `turn` to this body; else a vector at random.
  MeasuredStep(const Body& body, const MeasuredStep* kept, const Eigen::Matrix3d& turn);
  double limit(Body& body, int iterations);
  void visit_state(StateArchive& archive) { archive.values(x_.values); }

 private:
  NodeField x_;
};

}  // namespace granulaw
