#include "solver/spatial/spatial_recorder.hpp"

namespace granulaw {

void SpatialRecorder::begin(const SpatialScene&) {}

void SpatialRecorder::record(const SpatialScene&, double, double, double) {}

}  // namespace granulaw
