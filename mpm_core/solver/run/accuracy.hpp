#pragma once

#include <functional>
#include <span>

#include "solver/runs.hpp"

namespace granulaw {

/// A run of one job under given options: impact() or press() with everything else bound.
using Run = std::function<RunResult(const RunOptions&)>;

/// Coarse partner of a resolution: 0.7 of it, at least 6. Of each rung of a ladder n, n/0.7, ... the rung below.
int coarse_partner(int resolution);
/// The rung above: n/0.7.
int finer_rung(int resolution);

/// Error rule of the cells: a change c from coarser to finer cells leaves u = safety c/(r^order - 1), r the ratio
/// of their cells (Roache, J. Fluids Eng. 116, 1994, eq. 5).
struct CellsRule
{
  double safety, order;

  double left(double change, double cell_ratio) const;
  /// Error of the cells if several runs were repeated: u^2 = (left of the mean change)^2 + 2 variance. The
  /// mean is shared by all runs and extrapolated; the scatter is the noise of two single grids, of which one
  /// has 1/sqrt(2); twice that bounds 95 % of the runs.
  double left(std::span<const double> changes, double cell_ratio) const;
};
/// Bodies of revolution: order measured with 17, 24 and 48 cells, 25 impacts and presses, E*/Y 30 to 2000
/// (docs/develop/notes.md).
inline constexpr CellsRule rule_of_revolution{1.25, 1.65};
/// Three dimensions: errors of a cut surface fall like h.
inline constexpr CellsRule spatial_rule{1, 1};

/// Relative (0.01 is 1 %).
struct CellsError
{
  double force = 0;        ///< of the loading force
  double restitution = 0;  ///< of e; at least the force's, as two e may agree by chance
};

/// Error of the finer of two runs of one job that differ in their cells, for laws fitted through the grid noise.
/// The change of the force is the largest between 0.4 and 1 of the overlap, by smooth fits of ln F over
/// ln delta (TreatedLoading): grid noise of the contact edge and ringing of an impact are in no fit, and two
/// curves do not agree by chance, as two peaks do. Infinite where thin layers give both runs the same grid.
CellsError error_of_cells(const RunResult& fine, const RunResult& coarse);

/// Error of the finer run itself, of F_max and e, the larger: by the same rule, from a change not below the grid
/// noise. Measured on the cases of tests/validation/error_study.cpp and, in three dimensions, on those of
/// docs/evidence/solver-accuracy.md, where both are listed.
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
inline constexpr ToleranceRange spatial_range{8, 100, 7};

/// Cells and cost that the tolerance still takes, after a resolution that does not meet it.
struct ToleranceForecast
{
  int cells = 0;           ///< of that resolution
  double estimate = 0;     ///< its error estimate
  int wanted_cells = 0;    ///< by the error rule of the cells, or the slower fall so far; may lie beyond the range
  double cpu_s = 0;        ///< of all runs up to there
};

/// Raises the resolution, step by step, until two of them agree to within `tolerance` in F_max and e; what
/// the time step and, for a press (`has_ramp`), the ramp contribute is measured at a coarse resolution, where
/// it costs little, and both are refined until they take no more than a quarter of the tolerance each.
/// options.resolution, courant and slowness are where it starts. `forecast` is called before each further resolution.
ToleranceResult run_to_tolerance(double tolerance, bool has_ramp, const RunOptions& options, const Run& run,
                                 const ToleranceRange& range = flat_range,
                                 const std::function<void(const ToleranceForecast&)>& forecast = {});

}  // namespace granulaw
