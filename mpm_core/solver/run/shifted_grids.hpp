#pragma once

#include <functional>
#include <vector>

#include "solver/output/trace.hpp"

namespace granulaw {

/// The contact-edge grid noise is a periodic function of where the edge stands within its cell. K runs of the
/// same job on grids whose lines are shifted by k/K of a cell see it at K equally spaced phases: their mean
/// is free of its first K - 1 harmonics, at K times the cost of a run whose single refinement would need
/// about K^2 times.

/// `job(shift, progress)` at `shifted_grids` shifts equally spaced in [-1/2, 1/2), on `threads` threads;
/// results in the order of the shifts whatever the order of completion. An exception in a job stops the
/// others and is rethrown.
std::vector<RunResult> run_on_shifted_grids(
    int shifted_grids, int threads, const std::function<void(double)>& progress,
    const std::function<RunResult(double shift, const std::function<void(double)>&)>& job);

/// Mean of the members' traces, segment by segment of the programme, each at the same fraction of its way
/// through the segment: the members reverse a few steps apart, and none of them loses its reversal.
std::vector<TraceSample> mean_trace(const std::vector<RunResult>& members);
/// The planes' samples that go with it.
std::vector<PlaneTrace> mean_planes(const std::vector<RunResult>& members);

}  // namespace granulaw
