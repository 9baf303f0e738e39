#include "characterise/build/adaptive_sampling.hpp"

#include "characterise/run/sampling_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace granulaw {

namespace {

/// A plan of a body, and the records that its runs go to.
struct SamplingPart
{
  const CharacterisedBody& body;
  const SamplingPlan& plan;
  ContactRecords& records;
};

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

/// Runs several plans as one batch.
void run(const std::vector<SamplingPart>& parts, const RunSource& source, BuildRuns& runs, double until)
{
  std::vector<RunJob> jobs;
  for (const SamplingPart& part : parts)
    for (RunJob& job : sampling_jobs(part.body, part.plan, source)) jobs.push_back(std::move(job));
  const std::vector<RunOutcome> outcomes = runs.make(jobs, until);
  auto next = outcomes.begin();
  for (const SamplingPart& part : parts) {
    const auto end = next + static_cast<std::ptrdiff_t>(part.plan.runs());
    add_to(part.records, part.plan, {next, end});
    next = end;
  }
}

/// One round: presses of the body without rate, its impacts, and with the first round the guide's spheres.
void run_round(const SamplingPlan& plan, const SamplingSetting& setting, ContactRecords& records,
               std::vector<OnsetSimilarity::Sphere>* spheres, BuildRuns& runs)
{
  SamplingPlan slow = plan, fast = plan;
  slow.fast_speeds.clear();
  slow.resolution = setting.press_cells;
  fast.presses.clear();
  fast.slow_impacts.clear();
  fast.resolution = setting.impact_cells;
  std::vector<SamplingPart> parts{{setting.slow, slow, records}, {setting.body, fast, records}};
  if (spheres)
    for (OnsetSimilarity::Sphere& sphere : *spheres)
      parts.push_back({sphere.body, sphere.plan, sphere.found});
  // of the progress that is left before the law is verified: how many rounds there will be is not known
  run(parts, setting.source, runs, runs.done() + 0.7 * (0.9 - runs.done()));
}

ElasticCorrection elastic_of(const ContactRecords& records, const SamplingSetting& s)
{
  return s.elastic_press ? measured_elastic(*s.elastic_press, records.slow, s.body.onset) : s.elastic;
}

FittedShape fit(const ContactRecords& records, const SamplingSetting& s, const ShapePrior* prior)
{
  if (s.known) {
    FittedShape fitted{*s.known, {}};
    fitted.shape.velocity_effects = fit_velocity_effects(records.fast, *s.known, s.body.onset, s.shape_end());
    return fitted;
  }
  return fit_shape(records, elastic_of(records, s), s.body.onset, s.options.depth, prior);
}

void fit_and_leave_out(Sampled& sampled, const SamplingSetting& s, const OnsetSimilarity* similarity)
{
  std::optional<ShapePrior> known;
  if (similarity) known = similarity->prior(elastic_of(sampled.records, s));
  const ShapePrior* prior = known ? &*known : nullptr;
  sampled.fitted = fit(sampled.records, s, prior);
  const auto shape_of = [&](const ContactRecords& others) { return fit(others, s, prior).shape; };
  sampled.slow = leave_out_slow(sampled.records, shape_of, s.body.onset, s.options.depth);
  sampled.fast =
      leave_out_fast(sampled.records.fast, sampled.fitted.shape.velocity_effects, axis_kind_of(s.body));
}

/// The runs that the law is still missing; none that was asked for before.
SamplingPlan refinement(const Sampled& sampled, const SamplingSetting& s, Asked& overlaps, Asked& speeds)
{
  const double tolerance = s.options.tolerance;
  const bool rate = axis_kind_of(s.body) == AxisTable::By::rate;
  std::optional<double> least_speed;
  if (!rate) least_speed = std::sqrt(negligible_damage_number(tolerance));
  std::vector<double> slow = overlaps.of(bisections(sampled.slow, tolerance));
  for (double& x : slow) x = std::exp(x);
  SamplingPlan more = slow_runs_to(slow, s.slow, tolerance, s.press_cells);
  more.fast_speeds = speeds.of(bisections(sampled.fast, tolerance, least_speed));
  if (rate)
    for (double& v : more.fast_speeds) v = std::exp(v);
  return more;
}

}  // namespace

AxisTable::By axis_kind_of(const CharacterisedBody& body)
{
  return body.rate_dependent() ? AxisTable::By::rate : AxisTable::By::inertia;
}

Sampled sample(SamplingPlan plan, const SamplingSetting& setting, OnsetSimilarity* guide, BuildRuns& runs)
{
  Sampled sampled;
  Asked overlaps, speeds;
  for (bool first = true; plan.runs() > 0; first = false) {
    run_round(plan, setting, sampled.records, guide && first ? &guide->spheres() : nullptr, runs);
    fit_and_leave_out(sampled, setting, guide);
    plan = refinement(sampled, setting, overlaps, speeds);
  }
  return sampled;
}

}  // namespace granulaw
