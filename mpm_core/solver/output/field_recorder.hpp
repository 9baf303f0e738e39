#pragma once

#include <algorithm>

#include "base/scales.hpp"
#include "solver/output/drawing.hpp"

namespace granulaw {

/// Hands frames of one run to its observer, in SI. Without an observer every call is a single test.
class FieldRecorder
{
 public:
  /// `duration`: of the run, about, solver units.
  FieldRecorder(const FieldObserver& observer, const Scales& scale, double duration)
      : observer_(observer), scale_(scale), interval_(duration / std::max(1, observer.frames - 1))
  {
  }

  /// The grids and the bodies at rest, time 0.
  void begin(std::span<const Body> bodies)
  {
    if (!observer_) return;
    Drawing drawing = draw(bodies);
    const int corners = static_cast<int>(drawing.frame.r.size());
    if (observer_.begin && !drawing.cells.empty()) observer_.begin(corners, drawing.cells);
    if (observer_.begin_solid && !drawing.solid_cells.empty())
      observer_.begin_solid(corners, drawing.solid_cells);
    record(std::move(drawing.frame), 0, 0, 0);
  }
  /// To be called at every trace sample, at the end of a step; makes a frame when one is due, or if `last`.
  /// Solver units.
  void sample(std::span<const Body> bodies, double time, double overlap, double force, bool last)
  {
    if (observer_ && (last || time >= next_)) record(draw(bodies).frame, time, overlap, force);
  }

 private:
  void record(FieldFrame frame, double time, double overlap, double force);

  FieldObserver observer_;
  Scales scale_;
  double interval_, next_ = 0;
};

}  // namespace granulaw
