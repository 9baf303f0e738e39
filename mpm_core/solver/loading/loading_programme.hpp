#pragma once

#include <vector>

#include "solver/runs.hpp"
#include "solver/contact/scene.hpp"

namespace granulaw {

/// What moves the bodies: sets velocities after the contact impulse of a step (before it, the reported
/// overlap would drift by the integral of F dt^2/m) and knows when the run is over. Solver units.
template <class Scene>
class BasicProgramme
{
 public:
  virtual ~BasicProgramme() = default;
  /// To be called before the contact of that step: velocities of planes that the programme moves.
  virtual void lead(Scene& /*scene*/, double /*time*/, double /*dt*/) {}
  /// Velocities for the step from `time` to `time + dt`; `touching`: the contact pushed in this step.
  virtual void apply(Scene& scene, double time, double dt, bool touching) = 0;
  virtual bool finished() const = 0;
  virtual Branch branch() const = 0;
  virtual int segment() const = 0;
  /// 0..1
  virtual double progress() const = 0;
  /// Overlap: displacement towards the plane of what the loading programme calls the body's position.
  virtual double overlap(const Scene& scene) const { return scene.overlap(); }
  /// Work done on the bodies by the loading programme so far (impact: none).
  virtual double work() const { return 0; }
  virtual void visit_state(StateArchive& archive) = 0;
};
using LoadingProgramme = BasicProgramme<Scene>;

/// Free bodies; over when they have parted for good.
template <class Scene>
class FreeFlight : public BasicProgramme<Scene>
{
 public:
  explicit FreeFlight(double expected_duration) : expected_(expected_duration) {}
  void apply(Scene& scene, double time, double dt, bool touching) override;
  bool finished() const override { return finished_; }
  Branch branch() const override { return rebounding_ ? Branch::unload : Branch::load; }
  int segment() const override { return rebounding_ ? 1 : 0; }
  double progress() const override;
  void visit_state(StateArchive& archive) override;

 private:
  double expected_, last_touch_ = 0, time_ = 0;
  bool rebounding_ = false, finished_ = false;
};
using ImpactProgramme = FreeFlight<Scene>;

/// Time without contact after which a body counts as having left: a few crossings of the contact zone would
/// do; a surface vibration can close the contact again within about one crossing of the sphere (2 R/c).
inline constexpr double leaving_time = 2.0;

/// Bodies pressed along smooth ramps by uniform body forces (free) or by the equator plane (midplane, one
/// body): overlap(t) from stop to stop as sin^2 (velocity zero at both ends, so also at first touch);
/// unloading at a speed that grows smoothly to a constant until the force has ended.
class PressProgramme : public LoadingProgramme
{
 public:
  struct Plan
  {
    std::vector<double>
        stops;           ///< ascending overlaps; after each the body is unloaded; the last is the depth
    double ramp;         ///< duration of loading from 0 to depth
    double unload_ramp;  ///< duration of an unloading, about
    Support support;
  };
  /// `e_star_contact`: 1/(1/E*_1 + 1/E*_2), which sets the speed of unloading.
  PressProgramme(const Plan& plan, double e_star_contact) : plan_(plan), e_star_(e_star_contact)
  {
    start_loading(0, 0);
  }
  void apply(Scene& scene, double time, double dt, bool touching) override;
  bool finished() const override { return finished_; }
  Branch branch() const override;
  int segment() const override { return segment_; }
  double progress() const override;
  double overlap(const Scene& scene) const override;
  double work() const override { return work_; }
  void visit_state(StateArchive& archive) override;
  /// Mean force and contact radius of the last sample: sets the speed of the next unloading.
  void observe(double force, double contact_radius) { force_ = force, radius_ = contact_radius; }

 private:
  enum class Phase { load, hold, unload, stop };
  void start_loading(double time, double overlap);
  void start_holding(double time);
  void start_unloading(double time);
  void start_next_stop(double time, double overlap);
  void continue_loading(Scene& scene, double time, double dt, double overlap);
  void continue_unloading(double time, double overlap);
  double target_velocity(double time) const;
  /// Bring the bodies, or the equator of the one body, to `velocity`, and count the work.
  void drive_bodies(Scene& scene, double velocity);
  void drive_equator(Body& body, double velocity, double dt);
  /// Takes `share` of every velocity relative to the loading programme's own out of the bodies.
  void damp(Scene& scene, double velocity, double share);

  Plan plan_;
  double e_star_;
  Phase phase_ = Phase::load;
  std::size_t stop_ = 0;
  int segment_ = 0;
  double start_ = 0, from_ = 0, duration_ = 1, speed_ = 0;
  double last_touch_ = 0, force_ = 0, radius_ = 1, work_ = 0;
  // Impulses do work on the mean of the velocities before and after a step: these are those of the last step
  double velocity_ = 0;  // of the equator, or of separation if free
  double mean_ = 0;      // midplane: of the centre of mass
  double driven_ = 0;    // displacement of the equator along +z
  bool reached_new_depth_ = false, finished_ = false;
  double deepest_ = 0;
};

}  // namespace granulaw
