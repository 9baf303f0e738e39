#pragma once

#include <vector>

#include "solver/loading/loading_programme.hpp"
#include "solver/contact/spatial_contact.hpp"

namespace granulaw {

/// Planes that move in together, delta(t) as sin^2 (velocity zero at both ends, so also at first touch), are
/// held, and go back at a speed that grows smoothly to a constant until none that moves pushes any more.
class PlanesProgramme : public BasicProgramme<SpatialScene>
{
 public:
  struct Plan
  {
    double depth, ramp, unload_ramp;
    std::vector<double> speeds;  ///< of each plane, over that of the programme
  };
  explicit PlanesProgramme(Plan plan) : plan_(std::move(plan)) {}
  void lead(SpatialScene& scene, double time, double dt) override;
  void apply(SpatialScene& scene, double time, double dt, bool touching) override;
  bool finished() const override { return finished_; }
  Branch branch() const override { return phase_ == Phase::unload ? Branch::unload : Branch::load; }
  int segment() const override { return phase_ == Phase::unload ? 1 : 0; }
  double progress() const override;
  double overlap(const SpatialScene&) const override { return delta_; }
  /// By the planes and, negative, by the damping.
  double work() const override { return work_; }
  void visit_state(StateArchive& archive) override;
  /// Mean force and contact radius of the last sample: sets the speed of the unloading.
  void observe(double force, double contact_radius) { force_ = force, radius_ = contact_radius; }
  /// Work of the planes up to the hold, and what came back since.
  double work_load() const { return work_load_; }
  double work_unload(const SpatialContact& contact) const { return work_load_ - contact.work(); }

 private:
  enum class Phase { load, hold, unload };
  double target_velocity(double time) const;
  bool moving_planes_push(const SpatialContact& contact) const;
  void damp(SpatialScene& scene, double share);

  Plan plan_;
  Phase phase_ = Phase::load;
  double start_ = 0, speed_ = 0, delta_ = 0, velocity_ = 0, last_touch_ = 0, now_ = 0;
  double force_ = 0, radius_ = 1, work_ = 0, damping_ = 0, work_load_ = 0;
  bool finished_ = false;
};

}  // namespace granulaw
