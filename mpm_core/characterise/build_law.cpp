#include "characterise/build_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "characterise/finish_curve.hpp"
#include "characterise/fit_curve.hpp"
#include "characterise/onset_similarity.hpp"
#include "characterise/refinement.hpp"
#include "characterise/resolution_choice.hpp"
#include "characterise/verification.hpp"

namespace granulaw {

namespace {

/// sqrt(I) of the slowest impact on a rate axis.
double slowest_of(const CharacterisedBody& body, const BuildOptions& o)
{
  const double onset = onset_velocity(1.0, body.yield, 1.0, body.poisson_ratio) / std::sqrt(body.yield);
  const double wanted = o.slowest > 0 ? o.slowest : o.fastest / 50;
  return std::min(std::max(wanted, onset), 0.5 * o.fastest);
}

/// rms of a press's loading force about a curve, over the upper half of its overlaps.
double scatter_about(const ContactCurve& curve, const ContactRecord& press)
{
  double sum = 0;
  int count = 0;
  for (const auto& [x, f, a] : press.loading) {
    if (x <= 0.5 * press.depth) continue;
    sum += std::pow(f / curve.loading(x).force - 1, 2);
    ++count;
  }
  return count ? std::sqrt(sum / count) : 0;
}

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

/// One build: what it shares between its steps.
class Build
{
 public:
  Build(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
        const RunSource& source);
  void elastic();
  void plastic();
  BuiltLaw take();

 private:
  /// What was run, the law's shape by it, and how that shape does without each run.
  struct Sampled
  {
    ContactRecords records;
    FittedShape fitted;
    std::vector<LeftOutRun> slow, fast;
  };
  /// A plan of a body, and the records that its runs go to.
  struct SamplingPart
  {
    const CharacterisedBody& body;
    const SamplingPlan& plan;
    ContactRecords& records;
  };

  /// Where the shape's functions of u end.
  double shape_end() const { return known_ ? Atlas::depth : options_.depth; }
  VelocityAxis::Kind axis_kind() const
  {
    return body_.rate_dependent() ? VelocityAxis::Kind::rate : VelocityAxis::Kind::inertia;
  }

  void require_lawful() const;
  SamplingRange widest_range() const;
  SamplingPlan first_plan() const;
  std::size_t most_runs(const std::optional<OnsetSimilarity>& guide) const;

  void resolve(const SamplingPlan& plan);
  std::vector<Probe> probes(const SamplingPlan& plan);
  RunJob elastic_press() const;
  void note_solver_error(const ResolutionChoice& choice);

  std::optional<OnsetSimilarity> onset_similarity(double first) const;
  Sampled sample(SamplingPlan plan, std::optional<OnsetSimilarity>& guide);
  void run_round(const SamplingPlan& plan, ContactRecords& records,
                 std::vector<OnsetSimilarity::Sphere>* spheres);
  void run(const std::vector<SamplingPart>& parts, double until);
  void heed_early_yield(const ContactRecords& records);
  FittedShape fit(const ContactRecords& records, const LawShape* guide, double guide_end) const;
  void fit_and_leave_out(Sampled& sampled, const std::optional<OnsetSimilarity>& guide) const;
  SamplingPlan refinement(const Sampled& sampled, Asked& overlaps, Asked& speeds) const;

  void certify(const Sampled& sampled);
  void verify_impacts(const ContactRecords& records);

  BuiltLaw built_;
  BodyLaw& law_ = built_.law;
  CharacterisedBody body_;  ///< its onset is what the runs show, where that is earlier than foreseen
  CharacterisedBody
      slow_;  ///< the body at no rate: its law is the rate-free one, the speed axis brings the rate in
  const BuildOptions& options_;
  const RunSource& source_;
  BuildRuns runs_;
  std::optional<LawShape> known_;  ///< a rate-dependent body's law at no rate, where the atlas tells it
  ElasticCorrection elastic_;
  int press_cells_ = first_resolution, impact_cells_ = first_resolution;
};

Build::Build(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
             const RunSource& source)
    : body_(body),
      slow_(body.rate_dependent() ? body.rate_free() : body),
      options_(options),
      source_(source),
      runs_(options)
{
  law_.material = material;
  if (!body.rate_dependent() || !slow_.is_plain()) return;
  if (!options.atlas || options.tolerance < options.atlas->claimed_force()) return;
  if (const MaterialRatios ratios = MaterialRatios::of(material); options.atlas->why_not(ratios).empty())
    known_ = options.atlas->shape(ratios);
}

BuiltLaw Build::take()
{
  built_.holes = runs_.holes();
  return std::move(built_);
}

// -- plan --

void Build::require_lawful() const
{
  const std::string where = fmt::format("material '{}'", law_.material.name);
  if (body_.onset > 0.2 * options_.depth)
    fail(where, "yields too late in the overlaps that a law covers",
         fmt::format("onset at delta/R = {:.3g}", body_.onset),
         fmt::format("up to {:.3g}", 0.2 * options_.depth));
  if (body_.rate_dependent() && options_.fastest == 0)
    fail(where, "depends on the rate: its law needs impacts, not the rate-free law alone", "I = 0", "over 0");
}

/// The runs to begin with: two reversal points a press, the fewest impacts.
SamplingPlan Build::first_plan() const
{
  std::vector<double> speeds;
  if (body_.rate_dependent())
    speeds = first_rate_speeds(slowest_of(body_, options_), options_.fastest);
  else if (options_.fastest > 0)
    speeds = first_inertia_speeds(options_.fastest, options_.tolerance);
  SamplingRange range = widest_range();
  range.stops = 2;
  range.speeds = speeds;
  return plan_sampling(slow_, range);
}

/// How many runs the densest plan has: a rate's impacts as near to each other as refinement puts them.
std::size_t Build::most_runs(const std::optional<OnsetSimilarity>& guide) const
{
  SamplingRange range = widest_range();
  if (body_.rate_dependent()) range.speeds = {};
  std::size_t runs = plan_sampling(slow_, range).runs();
  if (body_.rate_dependent())
    runs += 1 + static_cast<std::size_t>(std::log(options_.fastest / slowest_of(body_, options_)) /
                                         least_interval(options_.tolerance));
  if (guide)
    for (const OnsetSimilarity::Sphere& sphere : guide->spheres()) runs += sphere.plan.runs();
  return runs;
}

SamplingRange Build::widest_range() const
{
  SamplingRange range;
  range.depth = options_.depth;
  range.fastest = options_.fastest;
  range.tolerance = options_.tolerance;
  return range;
}

// -- resolve --

/// What shows the error of a plan's runs: a fast impact, which rings and may want more cells than a press,
/// but costs less, and the cheapest of its presses on shifted grids, which the sampling takes over.
std::vector<Probe> Build::probes(const SamplingPlan& plan)
{
  std::vector<Probe> probes;
  const double speed = options_.fastest > 0 ? std::min(ringing, options_.fastest) : ringing;
  // two shifted grids leave so much grid noise that their difference is chance
  probes.push_back({[this, velocity = speed * std::sqrt(body_.yield)](int cells) {
                      return impact_job(body_, velocity, cells, fast_shifted_grids, source_);
                    },
                    &impact_cells_});
  const auto cost = [&](const SamplingPlan::Press& press) {
    return press.shifted_grids > 1 ? press_job(slow_, press, source_).cost
                                   : std::numeric_limits<double>::infinity();
  };
  const auto cheapest = std::min_element(plan.presses.begin(), plan.presses.end(),
                                         [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
  if (cheapest != plan.presses.end())
    probes.push_back({[this, press = *cheapest](int cells) mutable {
                        press.resolution = cells;
                        return press_job(slow_, press, source_);
                      },
                      &press_cells_});
  return probes;
}

RunJob Build::elastic_press() const
{
  return press_job(body_.elastic(), elastic_press_of(body_, press_cells_), source_);
}

void Build::note_solver_error(const ResolutionChoice& choice)
{
  law_.certificate.solver_error_force = choice.error.force;
  law_.certificate.solver_error_restitution = choice.error.restitution;
}

/// The resolution of each kind of run, and the elastic correction at that of the presses.
void Build::resolve(const SamplingPlan& plan)
{
  std::vector<RunJob> beside;
  if (!known_) beside.push_back(elastic_press());
  const ResolutionChoice choice = choose_resolutions(probes(plan), beside, options_.tolerance, runs_);
  note_solver_error(choice);
  if (known_) return;
  RunOutcome press = choice.beside.front();
  if (press_cells_ > first_resolution)
    press = runs_.make_needed({elastic_press()}, runs_.done() + 0.05, "the elastic press").front();
  elastic_ = fit_elastic(contact_record_of(press.result));
}

// -- sample --

/// What tells the law below `first`, the overlap of the shallowest run planned, if that is far from the
/// onset.
std::optional<OnsetSimilarity> Build::onset_similarity(double first) const
{
  if (known_ || first <= 2 * body_.onset) return {};
  OnsetSimilarity::Needs needs;
  needs.first = first, needs.depth = options_.depth;
  needs.tolerance = options_.tolerance, needs.press_cells = press_cells_;
  return OnsetSimilarity(body_, needs, options_.atlas);
}

/// The onset foreseen for a body of several materials is an estimate: a run that reversed before it and lost
/// energy has yielded.
void Build::heed_early_yield(const ContactRecords& records)
{
  constexpr double lost = 0.01;  // of the work: the waves that a slow elastic run leaves in the body are less
  for (const ContactRecord& p : records.slow)
    if (p.work_ratio < 1 - lost) body_.onset = std::min(body_.onset, 0.7 * p.depth);
}

/// Runs several plans as one batch.
void Build::run(const std::vector<SamplingPart>& parts, double until)
{
  std::vector<RunJob> jobs;
  for (const SamplingPart& part : parts)
    for (RunJob& job : sampling_jobs(part.body, part.plan, source_)) jobs.push_back(std::move(job));
  const std::vector<RunOutcome> outcomes = runs_.make(jobs, until);
  auto next = outcomes.begin();
  for (const SamplingPart& part : parts) {
    const auto end = next + static_cast<std::ptrdiff_t>(part.plan.runs());
    add_to(part.records, part.plan, {next, end});
    next = end;
  }
}

/// One round: presses of the body at no rate, its impacts, and with the first round the guide's spheres.
void Build::run_round(const SamplingPlan& plan, ContactRecords& records,
                      std::vector<OnsetSimilarity::Sphere>* spheres)
{
  SamplingPlan slow = plan, fast = plan;
  slow.fast_speeds.clear();
  slow.resolution = press_cells_;
  fast.presses.clear();
  fast.slow_impacts.clear();
  fast.resolution = impact_cells_;
  std::vector<SamplingPart> parts{{slow_, slow, records}, {body_, fast, records}};
  if (spheres)
    for (OnsetSimilarity::Sphere& sphere : *spheres)
      parts.push_back({sphere.body, sphere.plan, sphere.found});
  run(parts, runs_.done() + 0.7 * (0.9 - runs_.done()));
}

FittedShape Build::fit(const ContactRecords& records, const LawShape* guide, double guide_end) const
{
  if (known_) {
    FittedShape fitted{*known_, {}};
    fitted.shape.velocity_effects = fit_velocity_effects(records.fast, *known_, body_.onset, shape_end());
    return fitted;
  }
  return fit_shape(records, elastic_, body_.onset, options_.depth, guide, guide_end);
}

void Build::fit_and_leave_out(Sampled& sampled, const std::optional<OnsetSimilarity>& guide) const
{
  std::optional<LawShape> shallow;
  if (guide) shallow = guide->shape(elastic_);
  const LawShape* told = shallow ? &*shallow : nullptr;
  const double told_end = guide ? guide->end() : 1.0;
  sampled.fitted = fit(sampled.records, told, told_end);
  const auto shape_of = [&](const ContactRecords& others) { return fit(others, told, told_end).shape; };
  sampled.slow = leave_out_slow(sampled.records, shape_of, body_.onset, options_.depth);
  sampled.fast = leave_out_fast(sampled.records.fast, sampled.fitted.shape.velocity_effects, axis_kind());
}

/// The runs that the law is still missing; none that was asked for before.
SamplingPlan Build::refinement(const Sampled& sampled, Asked& overlaps, Asked& speeds) const
{
  const bool rate = axis_kind() == VelocityAxis::Kind::rate;
  std::optional<double> least_speed;
  if (!rate) least_speed = std::sqrt(negligible_damage_number(options_.tolerance));
  std::vector<double> slow = overlaps.of(bisections(sampled.slow, options_.tolerance));
  for (double& x : slow) x = std::exp(x);
  SamplingPlan more = slow_runs_to(slow, slow_, options_.tolerance, press_cells_);
  more.fast_speeds = speeds.of(bisections(sampled.fast, options_.tolerance, least_speed));
  if (rate)
    for (double& v : more.fast_speeds) v = std::exp(v);
  return more;
}

/// Runs, fits and refines until no interval is left to bisect.
Build::Sampled Build::sample(SamplingPlan plan, std::optional<OnsetSimilarity>& guide)
{
  Sampled sampled;
  Asked overlaps, speeds;
  for (bool first = true; plan.runs() > 0; first = false) {
    run_round(plan, sampled.records, guide && first ? &guide->spheres() : nullptr);
    if (!body_.particle.is_homogeneous_sphere()) heed_early_yield(sampled.records);
    fit_and_leave_out(sampled, guide);
    plan = refinement(sampled, overlaps, speeds);
  }
  return sampled;
}

// -- certify, tabulate, verify --

/// What the runs and their fit say of the law's errors.
void Build::certify(const Sampled& sampled)
{
  Certificate& c = law_.certificate;
  c.damage_number_max = options_.fastest * options_.fastest;
  c.reload_loop_area = sampled.records.reload_loop;
  c.residual_scatter = sampled.fitted.quality.scatter;
  c.held_out_error = largest_miss_of_restitution(sampled.slow);
  built_.sampling_error = largest_miss(sampled.slow);
  if (!known_) return;
  built_.rate_free = "from the atlas";
  c.atlas_error_force = options_.atlas->claimed_force();
  c.atlas_error_restitution = options_.atlas->claimed_restitution();
}

void Build::verify_impacts(const ContactRecords& records)
{
  constexpr std::size_t of_inertia = 3, of_rate = 4;  // impacts; a rate's axis is the longer one
  const double fastest = std::sqrt(law_.certificate.damage_number_max);
  const std::vector<double> speeds = verification_speeds(
      records.fast, fastest, axis_kind(), axis_kind() == VelocityAxis::Kind::rate ? of_rate : of_inertia);
  const double error = verify(law_, body_, speeds, impact_cells_, source_, runs_);
  built_.sampling_error = std::max(built_.sampling_error, error);
}

void Build::plastic()
{
  require_lawful();
  SamplingPlan plan = first_plan();
  const double first = plan.slow_impacts.empty() ? plan.presses.front().stops.front()
                                                 : expected_depth(plan.slow_impacts.front(), slow_);
  if (known_) plan.presses.clear(), plan.slow_impacts.clear();
  resolve(plan);
  for (SamplingPlan::Press& press : plan.presses) press.resolution = std::max(press.resolution, press_cells_);
  std::optional<OnsetSimilarity> guide = onset_similarity(first);
  // the first impact would show what is known then, for a third of the time
  if (guide && guide->spares_first() && !plan.slow_impacts.empty())
    plan.slow_impacts.erase(plan.slow_impacts.begin());

  const std::size_t before = runs_.count();
  const Sampled sampled = sample(plan, guide);
  built_.runs_full = most_runs(guide);
  if (guide) built_.shallow = guide->how();

  certify(sampled);
  const LawShape& shape = sampled.fitted.shape;
  law_.certificate.interpolation_error = finish_curve(law_, shape, body_, options_, shape_end());
  built_.change_of_restitution = change_of_restitution(shape, body_.onset, shape_end(), law_.curve);
  if (options_.fastest > 0) verify_impacts(sampled.records);
  built_.runs = runs_.count() - before;
}

// -- an elastic body --

void Build::elastic()
{
  const auto press = [&](double share, int cells) {
    return press_job(body_, {share * options_.depth, {}, cells, 2}, source_);
  };
  note_solver_error(choose_resolutions({{[&](int cells) { return press(1.0, cells); }, &press_cells_}}, {},
                                       options_.tolerance, runs_));
  // the contact of the deep press begins with too few cells
  const std::vector<RunJob> jobs{press(0.15, press_cells_), press(1.0, press_cells_)};
  std::vector<ContactRecord> presses;
  for (const RunOutcome& outcome : runs_.make_needed(jobs, 1.0, "the elastic press"))
    presses.push_back(contact_record_of(outcome.result));
  const ElasticFit fit = fit_elastic(presses);
  law_.curve = ContactCurve(tabulate_elastic(fit.correction, options_.depth), law_.material.name);
  Certificate& c = law_.certificate;
  c.interpolation_error = fit.error;
  c.residual_scatter = scatter_about(law_.curve, presses.back());
  c.damage_number_max = std::numeric_limits<double>::infinity();
  built_.runs = built_.runs_full = runs_.count();
}

}  // namespace

BuiltLaw build_law(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
                   const RunSource& source)
{
  check(options);
  Build build(material, body, options, source);
  if (body.yields())
    build.plastic();
  else
    build.elastic();
  return build.take();
}

}  // namespace granulaw
