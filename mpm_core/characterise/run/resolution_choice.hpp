#pragma once

#include <functional>
#include <vector>

#include "characterise/run/build_runs.hpp"
#include "characterise/run/grid_convergence.hpp"

namespace granulaw {

/// Cells that a law's runs begin with.
inline constexpr int first_resolution = 24;

/// A run that stands for others of its kind, whose resolution is to be chosen.
struct Probe
{
  std::function<RunJob(int cells)> run;
  int* cells;  ///< the choice
};

struct ResolutionChoice
{
  DiscretisationError error;       ///< largest of the probes, at the chosen cells
  std::vector<RunOutcome> beside;  ///< of the jobs made beside the first probes
};

/// Chooses each probe's cells: the fewest at which its grid convergence index is within the tolerance. Throws
/// Error where the most are not enough.
ResolutionChoice choose_resolutions(std::vector<Probe> probes, const std::vector<RunJob>& beside,
                                    double tolerance, BuildRuns& runs);

}  // namespace granulaw
