#pragma once

#include "base/scales.hpp"
#include "solver/output/fields.hpp"
#include "solver/scene.hpp"

namespace granulaw {

/// Hands frames of one run to its observer, in SI. Without an observer every call is a single test.
class FieldRecorder
{
 public:
  /// `duration`: of the run, about, solver units.
  FieldRecorder(const FieldObserver& observer, const Scales& scale, double duration);

  /// The grids and the bodies at rest, time 0.
  void begin(const Scene& scene);
  /// To be called at every trace sample, at the end of a step; makes a frame when one is due, or if `last`.
  /// Solver units.
  void sample(const Scene& scene, double time, double overlap, double force, bool last)
  {
    if (observer_ && (last || time >= next_)) record(scene, time, overlap, force);
  }

 private:
  void record(const Scene& scene, double time, double overlap, double force);

  FieldObserver observer_;
  Scales scale_;
  double interval_, next_ = 0;
};

}  // namespace granulaw
