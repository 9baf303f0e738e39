#include "solver/run/mean_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/run/shifted_grids.hpp"

namespace granulaw {

namespace {

/// Grid noise, as a fraction of the force, beyond which the fit does not describe the loading: fast, deep
/// impacts, where inertia makes the early force the largest.
constexpr double most_noise = 0.05;

/// Each number as the table says; the members' cost together.
RunSummary combined(const std::vector<RunResult>& members)
{
  RunSummary s;
  const double weight = 1.0 / static_cast<double>(members.size());
  double updates = 0;
  std::size_t sticking = 0;
  for (const RunResult& member : members) {
    const RunSummary& m = member.summary;
    for (const SummaryNumber& n : summary_numbers) {
      double& number = s.*n.value;
      if (n.combine == Combine::mean) number += weight * m.*n.value;
      if (n.combine == Combine::sum) number += m.*n.value;
      if (n.combine == Combine::largest) number = larger(number, m.*n.value);
    }
    s.steps += m.steps;
    sticking += m.sticks;
    s.points += m.points;
    updates += static_cast<double>(m.points) * static_cast<double>(m.steps);
  }
  for (const RunResult& member : members)
    s.restitution_spread =
        std::max(s.restitution_spread, std::abs(member.summary.restitution_raw - s.restitution_raw));
  s.points /= static_cast<long>(members.size());
  s.point_updates_per_s = updates / s.cpu_s;
  s.restitution = s.restitution_raw;
  s.sticks = 2 * sticking > members.size();
  return s;
}

/// By material; infinity where one of the members does not reach it.
std::vector<double> mean_yield_overlaps(const std::vector<RunResult>& members)
{
  std::vector<double> mean = members.front().yield_overlaps;
  for (std::size_t m = 0; m < mean.size(); ++m) {
    double sum = 0;
    for (const RunResult& member : members) sum += member.yield_overlaps[m];
    mean[m] = sum / static_cast<double>(members.size());
  }
  return mean;
}

/// Mean rebound of three-dimensional impacts.
std::optional<Rebound> mean_rebound(const std::vector<RunResult>& members)
{
  if (!members.front().rebound) return {};
  auto mean = numbers_of(Rebound{});
  for (const RunResult& member : members) {
    const auto numbers = numbers_of(*member.rebound);
    for (std::size_t k = 0; k < mean.size(); ++k)
      mean[k] += 1.0 / static_cast<double>(members.size()) * numbers[k];
  }
  return std::bit_cast<Rebound>(mean);
}

/// A single grid reverses at some phase of the grid noise, and the work given back follows the force at the
/// reversal. What is elastic is given back whatever the phase: only the dissipated share is corrected.
void correct_work_given_back(RunSummary& s, const std::vector<TraceSample>& trace,
                             const TreatedLoading& treated)
{
  double raw_over_treated = 0;
  int at_turn = 0;
  for (const TraceSample& t : trace)
    if (t.branch == Branch::load && t.delta >= 0.99 * s.delta_max) {
      raw_over_treated += t.force / treated.force(t.delta);
      ++at_turn;
    }
  if (!at_turn) return;
  const double dissipated = 1 - std::min(1.0, s.restitution_raw * s.restitution_raw);
  const double correction = 1 + (at_turn / raw_over_treated - 1) * dissipated;
  s.work_unload *= correction;
  s.restitution *= std::sqrt(correction);
}

/// Summary of one or several runs of the same job on shifted grids, whose mean trace is `trace`
/// (shifted_grids.hpp); solver units. The loading force is treated for the grid noise that is left
/// (grid_noise.hpp), but in the mean of impacts, after which the body `rings`.
RunSummary summary_of(const std::vector<TraceSample>& trace, const std::vector<RunResult>& members,
                      bool rings)
{
  RunSummary s = combined(members);
  for (const TraceSample& t : trace) s.force_max = std::max(s.force_max, t.force);
  const TreatedLoading treated(trace);
  if (!treated.valid()) return s;
  s.grid_noise = treated.grid_noise();
  // After an impact the body rings, and the force with it: the fit is 0.6 % (rms) off its peak however many
  // grids there are, up to 1.6 %. The smoothed peak of the mean is 0.23, 0.15, 0.13 % off with two, three,
  // four grids (against twelve grids of 1.4 times the resolution; 20 impacts, E*/Y 20 to 1800).
  if (rings && members.size() > 1) {
    if (const double peak = smoothed_peak(trace); peak > 0) s.force_max = peak;
    return s;
  }
  if (s.grid_noise > most_noise) return s;  // no grid noise about a smooth law any more: the raw peak stands
  s.force_max = treated.largest_force(s.delta_max);
  if (members.size() == 1) correct_work_given_back(s, trace, treated);
  return s;
}

}  // namespace

RunResult mean_of_shifted_grids(const RunOptions& options, int cells, int cells_made, const Scales& scale,
                                bool rings, const SingleRun& single)
{
  const auto one = [&](double shift, const std::function<void(double)>& report) {
    // all differences between the runs of one request
    const CheckpointSlot slot(options.checkpoints,
                              fmt::format("{} cells, shift {}, courant {}, slowness {}", cells, shift,
                                          options.courant, options.slowness));
    if (std::optional<RunResult> kept = slot.finished()) {
      report(1.0);
      return *std::move(kept);
    }
    // shifts are whole multiples of 1/(2 phases): 0 where there is one, else the one just below it
    const long half_steps = std::lround(2 * options.shifted_grids * shift);
    const bool shown = half_steps == 0 || half_steps == -1;
    RunResult made = single(cells, shift, shown ? options.fields : FieldObserver{}, report, slot);
    slot.keep_finished(made);
    return made;
  };
  const std::vector<RunResult> members =
      run_on_shifted_grids(options.shifted_grids, options.threads, options.progress, one);
  RunResult result;
  result.trace = mean_trace(members);
  result.summary = summary_of(result.trace, members, rings);
  result.yield_overlaps = mean_yield_overlaps(members);
  result.planes = mean_planes(members);
  result.rebound = mean_rebound(members);
  result.summary.resolution = cells_made;
  result.summary.grids = options.shifted_grids;
  return in_si(std::move(result), scale);
}

}  // namespace granulaw
