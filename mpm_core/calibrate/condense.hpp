#pragma once

#include "calibrate/measurement.hpp"

namespace granulaw {

/// Means of the rows of a curve that lie close together, for the rows: what a curve says does not depend on
/// how often it was read. A datum spans 1/100 of the displacement on loading, and on unloading a tenth of the
/// distance from the reversal point; `width` times as much. The rows next to a reversal point stay as they
/// are: they bound it.
void condense(Measurement& curve, double width = 1);

}  // namespace granulaw
