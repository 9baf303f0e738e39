#pragma once

#include <algorithm>

#include "base/scales.hpp"
#include "solver/output/fields.hpp"
#include "solver/spatial/spatial_scene.hpp"

namespace granulaw {

/// Hands frames of one three-dimensional run to its observer, in SI, as FieldRecorder does of axisymmetric
/// ones: the cells of the part that is computed, carried by the splines. Without an observer every call is a
/// single test.
class SpatialRecorder
{
 public:
  /// `duration`: of the run, about, solver units.
  SpatialRecorder(const FieldObserver& observer, const Scales& scale, double duration)
      : observer_(observer), scale_(scale), interval_(duration / std::max(1, observer.frames - 1))
  {
  }
  void begin(const SpatialScene& scene);
  void sample(const SpatialScene& scene, double time, double overlap, double force, bool last)
  {
    if (observer_ && (last || time >= next_)) record(scene, time, overlap, force);
  }

 private:
  void record(const SpatialScene& scene, double time, double overlap, double force);

  FieldObserver observer_;
  Scales scale_;
  double interval_, next_ = 0;
};

}  // namespace granulaw
