#pragma once

#include <functional>

#include "base/scales.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// One run: cells across, shift, who wants to see its fields, progress, where it keeps its state.
using SingleRun = std::function<RunResult(int, double, const FieldObserver&,
                                          const std::function<void(double)>&, const CheckpointSlot&)>;

/// Runs `single` on options.shifted_grids shifted grids. The fields shown are those of the grid whose shift
/// is nearest to zero.
/// `cells`: across the contact block; `cells_made`: those of the grid that they give (Setup). `rings`: the
/// body vibrates after the run, as after an impact.
RunResult mean_of_shifted_grids(const RunOptions& options, int cells, int cells_made, const Scales& scale,
                                bool rings, const SingleRun& single);

}  // namespace granulaw
