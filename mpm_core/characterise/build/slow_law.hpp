#pragma once

#include <string>

#include "atlas/atlas.hpp"
#include "contact/curve.hpp"
#include "farm/farm.hpp"
#include "solver/material/material.hpp"

namespace granulaw {

/// The rate-independent law of a sphere of this material on a rigid flat to overlap/R = `depth`, by runs.
Curve slow_law_by_runs(const std::string& name, const Material& material, double depth, const Atlas& atlas, Farm& farm,
                       const Progress& progress);

}  // namespace granulaw
