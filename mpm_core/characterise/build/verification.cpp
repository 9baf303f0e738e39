#include "characterise/build/verification.hpp"

#include "characterise/run/sampling_plan.hpp"

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"
#include "characterise/run/refinement.hpp"
#include "law/replay.hpp"

namespace granulaw {

std::vector<double> verification_speeds(const std::vector<ContactRecords::Impact>& impacts, double fastest,
                                        AxisTable::By kind, std::size_t count)
{
  const bool rate = kind == AxisTable::By::rate;
  std::vector<double> ends;
  if (!rate) ends.push_back(0);
  for (const ContactRecords::Impact& impact : impacts)
    if (impact.speed < fastest * (1 - 1e-9)) ends.push_back(impact.speed);
  ends.push_back(fastest);
  const std::size_t intervals = ends.size() - 1;
  count = std::min(count, intervals);
  std::vector<double> speeds;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (2 * k + 1) * intervals / (2 * count);
    speeds.push_back(rate ? std::sqrt(ends[i] * ends[i + 1]) : 0.5 * (ends[i] + ends[i + 1]));
  }
  return speeds;
}

double verify(BodyLaw& law, const CharacterisedBody& body, const std::vector<double>& speeds, int cells,
              const RunSource& source, BuildRuns& runs)
{
  const double unit_speed = std::sqrt(body.yield);
  std::vector<RunJob> jobs;
  for (const double v : speeds)
    jobs.push_back(impact_job(body, v * unit_speed, cells, fast_shifted_grids, source));
  const std::vector<RunOutcome> outcomes = runs.make(jobs, 1.0);
  Certificate& c = law.certificate;
  const Scales unit{body.scale.length, law.material.e_star(), law.material.density};
  double largest = 0;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (outcomes[k].failed()) continue;
    const RunSummary& run = outcomes[k].result.summary;
    const Replay replay =
        replay_on_wall(law, unit.length, body.mass * unit.mass(), speeds[k] * unit_speed * unit.velocity());
    const double force = std::abs(replay.force_max / unit.force() / run.force_max - 1);
    const double e = std::abs(replay.restitution / run.restitution - 1);
    c.verification_error_force = larger(c.verification_error_force, force);
    c.verification_error_restitution = larger(c.verification_error_restitution, e);
    c.verification_impacts += 1;
    largest = larger(largest, counted(force, e, run.restitution));
  }
  return largest;
}

}  // namespace granulaw
