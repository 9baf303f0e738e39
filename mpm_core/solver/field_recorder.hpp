#pragma once

#include "base/scales.hpp"
#include "solver/body.hpp"
#include "solver/fields.hpp"

namespace granulaw {

/// Hands frames of one run to its observer, in SI. Without an observer every call is a single test.
class FieldRecorder
{
 public:
  /// `duration`: of the run, about, solver units.
  FieldRecorder(const FieldObserver& observer, const Scales& scale, double duration);

  /// The grid and the body at rest, time 0.
  void begin(const Body& body);
  /// To be called at every trace sample, at the end of a step; makes a frame when one is due, or if `last`.
  /// Solver units.
  void sample(const Body& body, double time, double overlap, double force, bool last)
  {
    if (observer_ && (last || time >= next_)) record(body, time, overlap, force);
  }

 private:
  void record(const Body& body, double time, double overlap, double force);

  FieldObserver observer_;
  Scales scale_;
  double interval_, next_ = 0;
};

}  // namespace granulaw
