#pragma once

#include <optional>

#include "solver/loading/programme.hpp"

namespace granulaw {

/// The point of first contact in the rigid motion that has the body's momentum and angular momentum. The body
/// hardly turns during one contact: both are those at its start.
struct LeavingPoint
{
  Vector3 arm;  ///< from the centre of mass
  Eigen::Matrix3d inverse_inertia;
};

/// Free bodies; over when they have parted for good. With a point the run ends with the first contact, and
/// overlap and speed are the point's: a body hit off its centre turns while its centre still comes nearer.
/// Without one they are those of the centres of mass.
class Flight : public Programme
{
 public:
  /// `expected_duration`: R/c*, for the progress. `attracted`: it may stick, which also ends the run.
  explicit Flight(double expected_duration, std::optional<LeavingPoint> point = {}, bool attracted = false)
      : expected_(expected_duration), point_(std::move(point)), attracted_(attracted)
  {
  }
  void apply(Scene& scene, double time, double dt, bool touching) override;
  /// It came back while it still touched: attraction holds it.
  bool sticks() const { return sticks_; }
  bool finished() const override { return finished_; }
  Branch branch() const override { return rebounding_ ? Branch::unload : Branch::load; }
  int segment() const override { return rebounding_ ? 1 : 0; }
  double progress() const override;
  double overlap(const Scene& scene) const override { return point_ ? overlap_ : scene.overlap(); }
  void visit_state(StateArchive& archive) override;

 private:
  double leaving_speed(const Scene& scene) const;

  double expected_;
  std::optional<LeavingPoint> point_;
  bool attracted_;
  double overlap_ = 0, last_touch_ = 0, time_ = 0;
  bool rebounding_ = false, finished_ = false, sticks_ = false;
};

}  // namespace granulaw
