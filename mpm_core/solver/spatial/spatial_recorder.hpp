#pragma once

#include "base/scales.hpp"
#include "solver/output/fields.hpp"
#include "solver/spatial/spatial_scene.hpp"

namespace granulaw {

/// What FieldRecorder is to axisymmetric runs. Three-dimensional runs make no frames so far: check() of
/// spatial_runs.cpp refuses an observer.
class SpatialRecorder
{
 public:
  SpatialRecorder(const FieldObserver&, const Scales&, double) {}
  void begin(const SpatialScene&) {}
  void sample(const SpatialScene&, double, double, double, bool) {}
};

}  // namespace granulaw
