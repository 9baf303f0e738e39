#include "characterise/run/resolution_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "characterise/run/refinement.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

namespace {

/// A square root of two apart: u halves about every other time.
constexpr int resolutions[] = {first_resolution, 34, 48, 68};

constexpr double share_of_progress = 0.05;

DiscretisationError larger(const DiscretisationError& a, const DiscretisationError& b)
{
  return {std::max(a.force, b.force), std::max(a.restitution, b.restitution)};
}

/// `coarse`, or where thin layers give it the grid of `fine` the next coarser run whose grid is another.
RunResult of_another_grid(const Probe& probe, const RunResult& fine, RunResult coarse, int cells,
                          BuildRuns& runs)
{
  for (int next = coarse_partner(cells); coarse.summary.resolution >= fine.summary.resolution && next < cells;
       next = coarse_partner(cells)) {
    coarse = runs.make_needed({probe.run(next)}, share_of_progress, "one of the first runs").front().result;
    cells = next;
  }
  return coarse;
}

}  // namespace

ResolutionChoice choose_resolutions(std::vector<Probe> probes, const std::vector<RunJob>& beside,
                                    double tolerance, BuildRuns& runs)
{
  ResolutionChoice choice;
  double reached = 0;
  for (const int resolution : resolutions) {
    std::vector<RunJob> jobs;
    for (const Probe& probe : probes)
      for (const int cells : {resolution, coarse_partner(resolution)}) jobs.push_back(probe.run(cells));
    const auto probed = static_cast<std::ptrdiff_t>(jobs.size());
    if (resolution == first_resolution) jobs.insert(jobs.end(), beside.begin(), beside.end());
    const std::vector<RunOutcome> outcomes =
        runs.make_needed(jobs, share_of_progress, "one of the first runs");
    choice.beside.insert(choice.beside.end(), outcomes.begin() + probed, outcomes.end());

    std::vector<Probe> open;
    for (std::size_t k = 0; k < probes.size(); ++k) {
      const RunResult& fine = outcomes[2 * k].result;
      const RunResult coarse =
          of_another_grid(probes[k], fine, outcomes[2 * k + 1].result, coarse_partner(resolution), runs);
      const DiscretisationError found = grid_convergence(fine, coarse);
      const double error = larger(found.force, counted(found.restitution, fine.summary.restitution));
      if (!(error <= tolerance)) {  // an error that is no number is not met
        open.push_back(probes[k]);
        reached = error;
        continue;
      }
      *probes[k].cells = resolution;
      choice.error = larger(choice.error, found);
    }
    probes = open;
    if (probes.empty()) return choice;
  }
  fail("--tolerance", "not reached at the finest resolution: two resolutions still differ",
       fmt::format("{:.2g}", reached), fmt::format("{:.2g} or more", reached));
}

}  // namespace granulaw
