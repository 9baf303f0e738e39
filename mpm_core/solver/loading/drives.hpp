#pragma once

#include <vector>

#include "solver/contact/planes.hpp"
#include "solver/contact/scene.hpp"

namespace granulaw {

/// Motion of the bodies of a press. `speed`: at which the overlap grows.
class Drive
{
 public:
  virtual ~Drive() = default;
  /// Before the contact of a step: planes.
  virtual void lead(Scene& /*scene*/, double /*speed*/) {}
  /// After it: bodies, and the overlap.
  virtual void set(Scene& scene, double speed, double dt) = 0;
  virtual double overlap(const Scene& scene) const = 0;
  /// Work on the bodies so far, without that of the damping.
  virtual double work(const Scene& scene) const = 0;
  /// Velocity of a body that is no vibration.
  virtual Vector3 bulk_velocity(const Scene& scene, const Body& body, double speed) const = 0;
  /// True if there was contact in the step; `pushed`: the first side of the contact did.
  virtual bool touches(const Scene& /*scene*/, bool pushed) const { return pushed; }
  virtual void visit_state(StateArchive& archive) = 0;
};

/// Equal and opposite uniform body forces: two bodies share the change of velocity as the inverse of their
/// masses.
class BodyForce : public Drive
{
 public:
  void set(Scene& scene, double speed, double dt) override;
  double overlap(const Scene& scene) const override { return scene.overlap(); }
  double work(const Scene&) const override { return work_; }
  Vector3 bulk_velocity(const Scene& scene, const Body& body, double speed) const override;
  void visit_state(StateArchive& archive) override;

 private:
  double work_ = 0;
  /// An impulse does work on the mean of the velocities before and after a step: that of the last step.
  double velocity_ = 0;
};

/// The equator plane of one half body. A uniform body force carries the bulk along with the equator: without
/// it the accelerating equator would have to push the half sphere's mass through the body, and the force
/// would lag behind the overlap.
class EquatorPlane : public Drive
{
 public:
  void set(Scene& scene, double speed, double dt) override;
  double overlap(const Scene&) const override { return -driven_; }
  double work(const Scene&) const override { return work_; }
  Vector3 bulk_velocity(const Scene& scene, const Body& body, double speed) const override;
  void visit_state(StateArchive& archive) override;

 private:
  double work_ = 0, velocity_ = 0;
  double mean_ = 0;    ///< velocity of the centre of mass after the last step
  double driven_ = 0;  ///< displacement of the equator along +z
};

/// Planes that move in together.
class MovingPlanes : public Drive
{
 public:
  /// `speeds`: of each plane, over that of the programme.
  explicit MovingPlanes(std::vector<double> speeds) : speeds_(std::move(speeds)) {}
  void lead(Scene& scene, double speed) override;
  void set(Scene&, double speed, double dt) override { driven_ += dt * speed; }
  double overlap(const Scene&) const override { return driven_; }
  double work(const Scene& scene) const override { return scene.contact->work(); }
  Vector3 bulk_velocity(const Scene&, const Body& body, double) const override { return mean_velocity(body); }
  /// A plane that stands still may hold the body for good: the walls of a die do.
  bool touches(const Scene& scene, bool pushed) const override;
  void visit_state(StateArchive& archive) override;

 private:
  std::vector<double> speeds_;
  double driven_ = 0;
};

}  // namespace granulaw
