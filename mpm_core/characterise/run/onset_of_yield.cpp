#include "characterise/run/onset_of_yield.hpp"

#include "characterise/run/sampling_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace granulaw {

SamplingPlan::Press elastic_press_of(const CharacterisedBody& body, int cells)
{
  return {std::clamp(1.5 * body.onset, 0.02, 0.04), {}, cells, 2};
}

RunJob elastic_press_job(const CharacterisedBody& body, int cells, const RunSource& source, double depth)
{
  SamplingPlan::Press press = elastic_press_of(body, cells);
  if (depth > 0) press.depth = depth;
  RunJob job = press_job(body.elastic(), press, source);
  if (body.is_uniform()) return job;
  std::vector<double> yields;
  for (const Material& m : body.particle.materials) {
    yields.push_back(m.yield_stress);
    job.key += fmt::format(" yield={:.17g}", m.yield_stress);
  }
  job.run = [yields, plain = std::move(job.run)](const RunOptions& options) {
    RunOptions watched = options;
    watched.yield_stresses = yields;
    return plain(watched);
  };
  return job;
}

double onset_of_yield(const CharacterisedBody& body, const RunResult& press)
{
  // of the press's depth: the contact spans eight of 24 cells
  constexpr double resolved = 0.1;
  double onset = pole_onset(body);
  for (std::size_t m = 0; m < press.yield_overlaps.size(); ++m) {
    const double overlap = press.yield_overlaps[m];
    if (static_cast<int>(m) == body.pole_material && overlap < resolved * press.summary.delta_max) continue;
    onset = std::min(onset, overlap);
  }
  return onset;
}

}  // namespace granulaw
