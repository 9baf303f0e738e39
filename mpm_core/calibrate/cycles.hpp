#pragma once

#include "calibrate/problem.hpp"

namespace granulaw {

/// Removes partial unloadings that have another stiffness than the rest of their curve shows, loading and
/// last unloading: no parameters follow both. Measurement::set_aside names each. A curve without a last
/// unloading keeps all of its partial ones.
void set_cycles_aside(const Atlas& atlas, CalibrationRequest& request);

}  // namespace granulaw
