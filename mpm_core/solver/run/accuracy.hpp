#pragma once

#include <functional>

#include "solver/runs.hpp"

namespace granulaw {

/// A run of one job under given options: impact() or press() with everything else bound.
using Run = std::function<RunResult(const RunOptions&)>;

/// The coarse partner of a resolution: 0.7 of it, at least 6.
int coarse_partner(int resolution);

/// Error of the finer of two runs of one job at resolutions N and coarse_partner(N), relative, of F_max and
/// e, the larger; infinity where thin layers give both the same grid. Measured on the cases of
/// tests/validation/error_study.cpp (docs/evidence/solver-accuracy.md), in three dimensions on those of
/// docs/evidence/solver-accuracy-3d.md.
double error_between(const RunResult& fine, const RunResult& coarse);

/// Runs the job and its coarse partner, or the next coarser one whose grid is another; error_estimate filled,
/// cost of all counted.
RunResult run_with_estimate(const RunOptions& options, const Run& run);

/// Result of run_to_tolerance.
struct ToleranceResult
{
  RunResult result;
  double resolution_error = 0;  ///< the three parts of result.summary.error_estimate
  double step_error = 0, ramp_error = 0;
  bool reached = false;
};

/// Cells across the block between which run_to_tolerance goes.
struct ToleranceRange
{
  int first, last;  ///< where the raising starts and ends
  int probe;        ///< where time step and ramp are varied: their effect on F and e does not depend on it
};
inline constexpr ToleranceRange flat_range{14, 120, 10};
/// Cost goes with the fourth power in three dimensions.
inline constexpr ToleranceRange spatial_range{8, 100, 7};

/// Raises the resolution, step by step, until two of them agree to within `tolerance` in F_max and e; what
/// the time step and, for a press (`has_ramp`), the ramp contribute is measured at a coarse resolution, where
/// it costs little, and both are refined until they take no more than a quarter of the tolerance each.
/// options.resolution, courant and slowness are where it starts.
ToleranceResult run_to_tolerance(double tolerance, bool has_ramp, const RunOptions& options, const Run& run,
                                 const ToleranceRange& range = flat_range);

}  // namespace granulaw
