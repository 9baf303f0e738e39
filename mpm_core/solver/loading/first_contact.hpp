#pragma once

#include "solver/loading/loading_programme.hpp"
#include "solver/contact/spatial_scene.hpp"

namespace granulaw {

/// A free body until its first contact with the first plane has ended. Overlap and speed are the contact
/// point's in the rigid motion: a body hit off its centre turns while its centre still comes nearer.
class FirstContact : public BasicProgramme<SpatialScene>
{
 public:
  /// `expected_duration`: R/c*, for the progress. `arm`: from the centre of mass to the point.
  /// `inertia`: tensor about the centre of mass.
  FirstContact(double expected_duration, const Vector3& arm, const Eigen::Matrix3d& inertia);

  void apply(SpatialScene& scene, double time, double dt, bool touching) override;
  bool finished() const override { return finished_; }
  Branch branch() const override { return rebounding_ ? Branch::unload : Branch::load; }
  int segment() const override { return rebounding_ ? 1 : 0; }
  double progress() const override;
  double overlap(const SpatialScene&) const override { return overlap_; }
  void visit_state(StateArchive& archive) override;

 private:
  double leaving_speed(const SpatialScene& scene) const;

  double expected_;
  Vector3 arm_;
  Eigen::Matrix3d inverse_inertia_;
  double overlap_ = 0, last_touch_ = 0, time_ = 0;
  bool rebounding_ = false, finished_ = false;
};

}  // namespace granulaw
