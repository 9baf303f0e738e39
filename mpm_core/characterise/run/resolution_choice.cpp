#include "characterise/run/resolution_choice.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "characterise/run/refinement.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

namespace {

constexpr double share_of_progress = 0.05;

CellsError larger_of_each(const CellsError& a, const CellsError& b)
{
  return {larger(a.force, b.force), larger(a.restitution, b.restitution)};
}

/// A probe on its way up the ladder.
struct Climb
{
  const Probe* probe;
  RunResult fine, coarse;
};

/// Next coarser run with another grid, if thin layers give the coarser run the grid of the fine one.
void compare_with_another_grid(Climb& climb, int cells, BuildRuns& runs)
{
  for (int next = coarse_partner(cells);
       climb.coarse.summary.resolution >= climb.fine.summary.resolution && next < cells;
       next = coarse_partner(cells)) {
    climb.coarse = runs.make_needed({climb.probe->run(next)}, share_of_progress, "one of the first runs").front().result;
    cells = next;
  }
}

}  // namespace

ResolutionChoice choose_resolutions(const std::vector<Probe>& probes, const std::vector<RunJob>& beside,
                                    double tolerance, BuildRuns& runs)
{
  ResolutionChoice choice;
  const int below = coarse_partner(first_resolution);
  std::vector<RunJob> jobs = beside;
  for (const Probe& probe : probes) jobs.push_back(probe.run(below));
  std::vector<Climb> open;
  for (const Probe& probe : probes) open.push_back({&probe, {}, {}});
  double reached = 0;
  for (int cells = first_resolution, coarser = below; cells <= last_resolution;
       coarser = cells, cells = finer_rung(cells)) {
    for (const Climb& climb : open) jobs.push_back(climb.probe->run(cells));
    std::vector<RunOutcome> outcomes = runs.make_needed(jobs, share_of_progress, "one of the first runs");
    if (cells == first_resolution) {
      const auto end = outcomes.begin() + static_cast<std::ptrdiff_t>(beside.size());
      choice.beside.assign(outcomes.begin(), end);
      for (std::size_t k = 0; k < open.size(); ++k) open[k].fine = std::move(outcomes[beside.size() + k].result);
    }
    jobs.clear();
    const std::size_t before = outcomes.size() - open.size();
    std::vector<Climb> left;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Climb& climb = open[k];
      climb.coarse = std::move(climb.fine);
      climb.fine = std::move(outcomes[before + k].result);
      compare_with_another_grid(climb, coarser, runs);
      const CellsError found = climb.probe->error(climb.fine, climb.coarse);
      const double error = counted(found.force, found.restitution, climb.fine.summary.restitution);
      if (!(error <= tolerance)) {  // an error that is no number is not met
        reached = error;
        left.push_back(std::move(climb));
        continue;
      }
      *climb.probe->cells = cells;
      choice.error = larger_of_each(choice.error, found);
    }
    open = std::move(left);
    if (open.empty()) return choice;
  }
  fail("--tolerance", "not reached at the finest resolution: two resolutions still differ",
       fmt::format("{:.2g}", reached), fmt::format("{:.2g} or more", reached));
}

}  // namespace granulaw
