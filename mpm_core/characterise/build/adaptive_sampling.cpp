#include "characterise/build/adaptive_sampling.hpp"

#include "characterise/run/sampling_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace granulaw {

namespace {

/// Coordinates of runs that were asked for, whatever became of them.
class Asked
{
 public:
  /// Those that are new; from now on they are not.
  std::vector<double> of(std::vector<double> coordinates)
  {
    std::erase_if(coordinates,
                  [&](double c) { return std::find(asked_.begin(), asked_.end(), c) != asked_.end(); });
    asked_.insert(asked_.end(), coordinates.begin(), coordinates.end());
    return coordinates;
  }

 private:
  std::vector<double> asked_;
};

/// One round: slow runs of the body without rate, its impacts.
void run_round(const SamplingPlan& plan, const SamplingSetting& s, ContactRecords& records, BuildRuns& runs)
{
  SamplingPlan slow = plan, fast = plan;
  slow.fast_speeds.clear();
  slow.resolution = s.press_cells;
  fast.presses.clear();
  fast.slow_impacts.clear();
  fast.resolution = s.impact_cells;
  std::vector<RunJob> jobs = sampling_jobs(s.slow, slow, s.source);
  for (RunJob& job : sampling_jobs(s.body, fast, s.source)) jobs.push_back(std::move(job));
  // of the progress that is left before the law is verified: how many rounds there will be is not known
  const std::vector<RunOutcome> outcomes = runs.make(jobs, runs.done() + 0.7 * (0.9 - runs.done()));
  const auto middle = outcomes.begin() + static_cast<std::ptrdiff_t>(slow.runs());
  add_to(records, s.slow, slow, {outcomes.begin(), middle});
  if (const std::optional<LawShape> guide = s.guide(s.elastic))
    for (ContactRecord& record : records.slow)
      if (record.speed > 0) record = without_inertia(record, guide->velocity_effects);
  add_to(records, s.body, fast, {middle, outcomes.end()});
}

FittedShape fit(const ContactRecords& records, const SamplingSetting& s)
{
  const ElasticCorrection elastic =
      s.elastic_press ? measured_elastic(*s.elastic_press, records.slow, s.body.onset) : s.elastic;
  const std::optional<LawShape> guide = s.guide(elastic);
  if (s.known) {
    FittedShape fitted{*guide, {}};
    fitted.shape.velocity_effects = fit_velocity_effects(records.fast, *guide, guide->onset, guide->end);
    return fitted;
  }
  return guide ? fit_about(*guide, records) : fit_shape(records, elastic, s.body.onset, s.options.depth);
}

void fit_and_leave_out(Sampled& sampled, const SamplingSetting& s)
{
  sampled.fitted = fit(sampled.records, s);
  const auto shape_of = [&](const ContactRecords& others) { return fit(others, s).shape; };
  sampled.slow = leave_out_slow(sampled.records, shape_of, s.body.onset, s.options.depth, s.guided() ? 2 : 4);
  sampled.fast =
      leave_out_fast(sampled.records.fast, sampled.fitted.shape.velocity_effects, axis_kind_of(s.body));
}

/// The runs that the law is still missing; none that was asked for before.
SamplingPlan refinement(const Sampled& sampled, const SamplingSetting& s, Asked& overlaps, Asked& speeds)
{
  const double tolerance = s.options.tolerance;
  const bool rate = axis_kind_of(s.body) == AxisTable::By::rate;
  const double onset = s.body.onset;
  std::optional<Exact> at_onset, standstill;
  if (s.guided()) at_onset = {std::log(onset), std::log(nearest_to_onset * onset)};
  if (!rate) standstill = {0, std::sqrt(negligible_damage_number(tolerance))};
  std::vector<double> slow = overlaps.of(bisections(sampled.slow, tolerance, at_onset));
  for (double& x : slow) x = std::exp(x);
  SamplingPlan more = slow_runs_to(slow, s.slow, tolerance, s.press_cells, s.guided() ? slow_with_guide : slow_without);
  more.fast_speeds = speeds.of(bisections(sampled.fast, tolerance, standstill));
  if (rate)
    for (double& v : more.fast_speeds) v = std::exp(v);
  return more;
}

}  // namespace

AxisTable::By axis_kind_of(const CharacterisedBody& body)
{
  return body.rate_dependent() ? AxisTable::By::rate : AxisTable::By::inertia;
}

Sampled sample(SamplingPlan plan, const SamplingSetting& setting, BuildRuns& runs)
{
  Sampled sampled;
  Asked overlaps, speeds;
  while (plan.runs() > 0) {
    run_round(plan, setting, sampled.records, runs);
    fit_and_leave_out(sampled, setting);
    plan = refinement(sampled, setting, overlaps, speeds);
  }
  return sampled;
}

}  // namespace granulaw
