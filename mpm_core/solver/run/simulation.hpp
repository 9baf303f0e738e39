#pragma once

#include <functional>
#include <vector>

#include "solver/body/stable_step.hpp"
#include "solver/contact/scene.hpp"
#include "solver/loading/programme.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/field_recorder.hpp"
#include "solver/output/yield_watch.hpp"
#include "solver/run/time_step.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// One scene under one programme, from first touch to the end; solver units.
class Simulation
{
 public:
  /// `expected`: duration of the run, about, R/c*. `stress`: the solver's unit, Pa.
  Simulation(Scene scene, const RunOptions& options, double expected, double stress);

  /// Steps until the loading programme has finished, on from where `checkpoint` stands if that holds a state.
  /// Bodies and drive must be as at the start of the run.
  void run(Programme& programme, FieldRecorder fields, const std::function<void(double)>& progress,
           const CheckpointSlot& checkpoint = {});

  Scene scene;
  RunResult result;         // what is known at the end stands in result.summary
  double energy_start = 0;  // kinetic

  /// Raw work of the contact force on loading or, of the last segment, on unloading, by the trapezium rule
  /// over the samples.
  double loading_work() const { return work(true); }
  double unloading_work() const { return work(false); }

 private:
  double step_limit() const;
  double work(bool load) const;
  bool step(Programme& programme);
  void end_sample(Branch branch, int segment, double overlap_before, double put_in);
  void summarise(const Programme& programme);
  void visit_state(Programme& programme, StateArchive& archive);

  YieldWatch yield_watch_;
  std::vector<StableStep> stable_;
  double courant_;
  double window_;  // sample interval
  double window_end_ = 0;
  double longest_;  // give up
  // where the run is
  double time_ = 0, dt_ = 0, last_dt_ = 0, overlap_ = 0;
  long steps_ = 0;
  double cpu_s_ = 0;  // spent by the parts of this run before a restart, and by this one up to a checkpoint
  double last_touch_time_ = 0, last_touch_overlap_ = 0;
  double most_put_in_ = 0;  // energy put in so far, at most; of the part that is computed
  // the sample being taken
  double impulse_ = 0, overlap_sum_ = 0, window_start_ = 0;
  long in_window_ = 0;
};

}  // namespace granulaw
