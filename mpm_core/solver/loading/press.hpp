#pragma once

#include <memory>
#include <vector>

#include "solver/loading/drives.hpp"
#include "solver/loading/programme.hpp"

namespace granulaw {

/// Bodies pressed along smooth ramps, whatever drives them: overlap(t) from stop to stop as sin^2 (velocity
/// zero at both ends, so also at first touch); a hold; unloading at a speed that grows smoothly to a constant
/// until the force has ended.
class Press : public Programme
{
 public:
  struct Plan
  {
    std::vector<double>
        stops;           ///< ascending overlaps; after each the body is unloaded; the last is the depth
    double ramp;         ///< duration of loading from 0 to depth
    double unload_ramp;  ///< duration of an unloading, about
  };
  /// `e_star_contact`: 1/(1/E*_1 + 1/E*_2), which sets the speed of unloading.
  Press(Plan plan, double e_star_contact, std::unique_ptr<Drive> drive)
      : plan_(std::move(plan)), e_star_(e_star_contact), drive_(std::move(drive))
  {
    start_loading(0, 0);
  }
  void lead(Scene& scene, double time, double dt) override;
  void apply(Scene& scene, double time, double dt, bool touching) override;
  void observe(const TraceSample& sample) override { force_ = sample.force, radius_ = sample.contact_radius; }
  bool finished() const override { return finished_; }
  Branch branch() const override;
  int segment() const override { return segment_; }
  double progress() const override;
  double overlap(const Scene& scene) const override { return drive_->overlap(scene); }
  double work() const override { return work_ + damping_; }
  void visit_state(StateArchive& archive) override;
  /// Work of the drive in virgin loadings, holds included, and what the last unloading gave back.
  double work_load() const { return work_load_; }
  double work_unload() const { return work_at_unload_ - work_; }

 private:
  enum class Phase { load, hold, unload, stop };
  void start_loading(double time, double overlap);
  void start_unloading(double time);
  void start_next_stop(double time, double overlap);
  void continue_loading(Scene& scene, double dt, double overlap);
  void continue_unloading(double overlap);
  double target_speed(double time) const;
  /// Takes `share` of every velocity relative to the bulk's own out of the bodies.
  void damp(Scene& scene, double share);

  Plan plan_;
  double e_star_;
  std::unique_ptr<Drive> drive_;
  Phase phase_ = Phase::load;
  std::size_t stop_ = 0;
  int segment_ = 0;
  double start_ = 0, from_ = 0, duration_ = 1, unload_speed_ = 0;
  double speed_ = 0, now_ = 0, last_touch_ = 0, force_ = 0, radius_ = 1, deepest_ = 0;
  double work_ = 0, damping_ = 0, work_load_ = 0, work_at_unload_ = 0;
  bool reached_new_depth_ = false, finished_ = false;
};

}  // namespace granulaw
