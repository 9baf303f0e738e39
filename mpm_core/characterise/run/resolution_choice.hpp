#pragma once

#include <functional>
#include <vector>

#include "characterise/run/build_runs.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

/// Cells that a law's runs begin with, and the finest rung of their ladder: 24, 34, 49, 70.
inline constexpr int first_resolution = 24, last_resolution = 70;

/// A run that stands for others of its kind, whose resolution is to be chosen.
struct Probe
{
  std::function<RunJob(int cells)> run;
  int* cells;  ///< the choice
  std::function<CellsError(const RunResult& fine, const RunResult& coarse)> error = error_of_cells;
};

struct ResolutionChoice
{
  CellsError error;       ///< largest of the probes, at the chosen cells
  std::vector<RunOutcome> beside;  ///< of the jobs made beside the first probes
};

/// Chooses each probe's cells: the fewest of the ladder whose error is within the tolerance; each
/// rung is compared with the one below, which was run before. Throws Error where the most are not enough.
ResolutionChoice choose_resolutions(const std::vector<Probe>& probes, const std::vector<RunJob>& beside,
                                    double tolerance, BuildRuns& runs);

}  // namespace granulaw
