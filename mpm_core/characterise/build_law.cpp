#include "characterise/build_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/error.hpp"
#include "characterise/fit_curve.hpp"
#include "characterise/grid_convergence.hpp"
#include "characterise/interpolation.hpp"
#include "characterise/onset_similarity.hpp"
#include "characterise/tabulate_curve.hpp"
#include "characterise/tabulate_velocity_axis.hpp"
#include "law/replay.hpp"
#include "solver/run/accuracy.hpp"

namespace granulaw {

namespace {

constexpr int most_rounds = 5;
constexpr int resolutions[] = {24, 34, 48, 68};
constexpr double rate_factor = 2.2;  // between two impacts of a rate-dependent body, to begin with
constexpr double coarse_speeds[] = {0.06, 0.15, 0.25};  // sqrt(I): where a sampling plan begins

void check(const BuildOptions& o)
{
  if (!(o.depth > 0 && o.depth <= 0.5))
    fail("depth of the law", "cannot be used", fmt::format("{:g} R", o.depth), "over 0, up to 0.5 R");
  const double most = impact_speeds[std::size(impact_speeds) - 1];
  if (!(o.fastest >= 0 && o.fastest <= most))
    fail("fastest impact of the law", "cannot be used",
         fmt::format("I = rho V^2/Y = {:g}", o.fastest * o.fastest), fmt::format("0 to {:g}", most * most));
  if (!(o.slowest >= 0 && (o.slowest == 0 || o.slowest <= 0.7 * o.fastest)))
    fail("slowest impact of the law", "cannot be used",
         fmt::format("{:.3g} of the fastest", o.slowest / o.fastest), "up to 0.7 of it");
}

/// `from` to `to` in equal factors of at most `factor`.
std::vector<double> by_factors(double from, double to, double factor)
{
  const int steps = std::max(1, static_cast<int>(std::ceil(std::log(to / from) / std::log(factor) - 1e-9)));
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k)
    values.push_back(from * std::pow(to / from, static_cast<double>(k) / steps));
  return values;
}

/// Whether none of `tried` is about the same.
bool is_new(double value, const std::vector<double>& tried)
{
  return std::none_of(tried.begin(), tried.end(), [&](double t) { return std::abs(value / t - 1) < 0.12; });
}

/// An error relative to e as it counts for the tolerance.
double counted(double error, double restitution)
{
  return error * std::min(1.0, restitution / 0.5);
}

/// sqrt(I) of the slowest impact on a rate axis.
double slowest_of(const CharacterisedBody& body, const BuildOptions& o)
{
  const double onset = onset_velocity(1.0, body.yield, 1.0, body.poisson_ratio) / std::sqrt(body.yield);
  const double wanted = o.slowest > 0 ? o.slowest : o.fastest / 50;
  return std::min(std::max(wanted, onset), 0.5 * o.fastest);
}

}  // namespace

double finish_curve(BodyLaw& law, const LawShape& shape, const CharacterisedBody& body,
                    const BuildOptions& options, double shape_end)
{
  const ContactCurve slow = tabulate(shape, body.onset, shape_end, options.depth);
  const double error = table_error(shape, body.onset, shape_end, slow);
  if (options.fastest == 0) {
    law.curve = slow;
    return error;
  }
  const bool rate = body.rate_dependent();
  const VelocityAxis::Table axis =
      rate ? tabulate_rate(shape, slow, 1 / body.yield, body.mass, options.fastest, body.scale.length)
           : tabulate_inertia(shape, slow, 1 / body.yield, body.mass, options.fastest);
  law.certificate.damage_number_max = axis.speed_end * axis.speed_end;
  law.curve = ContactCurve(slow.table(), axis, law.material.name);
  require_admissible(law.curve);

  const Scales unit{body.scale.length, law.material.e_star(), law.material.density};
  const auto replay = [&](const ContactCurve& curve, double v) {
    BodyLaw other = law;
    other.curve = curve;
    return replay_on_wall(other, unit.length, body.mass * unit.mass(),
                          v * std::sqrt(body.yield) * unit.velocity());
  };
  double worst = 0;
  // what a rate raises at the fast end inertia may take away again
  for (const double v : {axis.speed_begin, axis.speed_end}) {
    if (v == 0) continue;
    const Replay with = replay(law.curve, v), without = replay(slow, v);
    law.certificate.axis_cost_force = without.force_max / with.force_max - 1;
    law.certificate.axis_cost_restitution = without.restitution / with.restitution - 1;
    worst = std::max(
        {worst, std::abs(law.certificate.axis_cost_force), std::abs(law.certificate.axis_cost_restitution)});
  }
  // Model only what the scene needs.
  if (worst <= options.tolerance) law.curve = slow;
  return error;
}

namespace {

/// One build: what it shares between its steps.
class Build
{
 public:
  Build(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
        const RunSource& source)
      : body_(body),
        slow_(body.rate_dependent() ? body.rate_free() : body),
        options_(options),
        source_(source)
  {
    built_.law.material = material;
    if (!body.rate_dependent() || !slow_.is_plain()) return;
    if (!options.atlas || options.tolerance < options.atlas->claimed_force()) return;
    if (const MaterialRatios ratios = MaterialRatios::of(material); options.atlas->why_not(ratios).empty())
      known_ = options.atlas->shape(ratios);
  }

  void elastic();
  void plastic();
  BuiltLaw take() { return std::move(built_); }

 private:
  /// Where the shape's functions of u end.
  double shape_end() const { return known_ ? Atlas::depth : options_.depth; }
  std::vector<RunOutcome> run(const std::vector<RunJob>& jobs, double until);
  /// A plan of a body, and the sampling plan that its runs go to.
  struct SamplingPart
  {
    const CharacterisedBody& body;
    const SamplingPlan& plan;
    ContactRecords& records;
  };
  void run(const std::vector<SamplingPart>& parts, double until);
  struct Probe
  {
    std::function<RunJob(int cells)> run;
    int* resolution;  // to be chosen
  };
  std::vector<Probe> probes(const SamplingPlan& plan);
  void choose_resolutions(std::vector<Probe> probes);
  RunJob elastic_press() const;
  ElasticCorrection elastic_correction();
  std::optional<OnsetSimilarity> onset_similarity(double first) const;
  void heed_early_yield(const ContactRecords& records);
  FittedShape fit(const ContactRecords& records, const std::optional<OnsetSimilarity>& guide) const;
  SamplingPlan refinement(const FittedShape& fitted, const ContactRecords& records,
                          const std::vector<double>& overlaps, const std::vector<double>& speeds) const;
  std::vector<double> more_speeds(const std::vector<LawShape::VelocityEffect>& found,
                                  const std::vector<ContactRecords::Impact>& impacts,
                                  const std::vector<double>& tried) const;
  void verify(const std::vector<double>& speeds);
  void require_lawful() const;
  SamplingRange widest_range() const;
  SamplingPlan first_plan() const;
  std::size_t most_runs(const std::optional<OnsetSimilarity>& guide) const;
  void run_round(const SamplingPlan& plan, ContactRecords& records,
                 std::vector<OnsetSimilarity::Sphere>* spheres);
  /// What was run, and the law's shape by it.
  struct Sampled
  {
    ContactRecords records;
    FittedShape fitted;
  };
  Sampled sample(SamplingPlan plan, std::optional<OnsetSimilarity>& guide);
  void certify(const Sampled& sampled);
  std::vector<double> verification_speeds(const ContactRecords& records) const;

  BuiltLaw built_;
  BodyLaw& law_ = built_.law;
  CharacterisedBody body_;  ///< its onset is what the runs show, where that is earlier than foreseen
  CharacterisedBody
      slow_;  ///< the body at no rate: its law is the rate-free one, the speed axis brings the rate in
  const BuildOptions& options_;
  const RunSource& source_;
  std::optional<LawShape> known_;  ///< a rate-dependent body's law at no rate, where the atlas tells it
  ElasticCorrection elastic_;
  int press_cells_ = resolutions[0], impact_cells_ = resolutions[0];
  double done_ = 0;
};

/// Makes runs, their part of the progress ending at `until`. Failed ones leave holes, which the law names.
std::vector<RunOutcome> Build::run(const std::vector<RunJob>& jobs, double until)
{
  const double from = done_;
  ThreadFarm alone(1);
  std::vector<RunOutcome> outcomes =
      (options_.farm ? options_.farm : &alone)->run(jobs, [&](double done, const std::string& what) {
        if (options_.progress) options_.progress(from + (until - from) * done, what);
      });
  done_ = until;
  built_.runs += jobs.size();
  for (std::size_t k = 0; k < outcomes.size(); ++k)
    if (outcomes[k].failed()) built_.holes.push_back(jobs[k].label + ": " + outcomes[k].error);
  return outcomes;
}

/// The same of several plans, as one batch.
void Build::run(const std::vector<SamplingPart>& parts, double until)
{
  std::vector<RunJob> jobs;
  for (const SamplingPart& part : parts)
    for (RunJob& job : sampling_jobs(part.body, part.plan, source_)) jobs.push_back(std::move(job));
  const std::vector<RunOutcome> outcomes = run(jobs, until);
  auto next = outcomes.begin();
  for (const SamplingPart& part : parts) {
    const auto end = next + static_cast<std::ptrdiff_t>(part.plan.runs());
    add_to(part.records, part.plan, {next, end});
    next = end;
  }
}

/// What shows the error of a plan's runs: the cheapest of its presses on shifted grids, which the sampling
/// plan takes over, and a fast impact, which rings and may want more cells than a press, but costs less.
std::vector<Build::Probe> Build::probes(const SamplingPlan& plan)
{
  std::vector<Probe> probes;
  const double speed = options_.fastest > 0 ? std::min(0.1, options_.fastest) : 0.1;
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

/// The resolution of each kind of run: that at which two of the probe agree within the tolerance. A yielding
/// body's elastic correction is made beside the first ones.
void Build::choose_resolutions(std::vector<Probe> probes)
{
  Certificate& c = law_.certificate;
  double reached = 0;
  for (const int resolution : resolutions) {
    std::vector<RunJob> jobs;
    for (const Probe& probe : probes)
      for (const int cells : {resolution, coarse_partner(resolution)}) jobs.push_back(probe.run(cells));
    const bool elastic = body_.yields() && !known_ && resolution == resolutions[0];
    if (elastic) jobs.push_back(elastic_press());
    const std::vector<RunOutcome> outcomes = run(jobs, 0.05);
    for (const RunOutcome& outcome : outcomes)
      if (outcome.failed()) fail("mpm table", "one of the first runs fails: " + outcome.error);
    if (elastic) elastic_ = fit_elastic(contact_record_of(outcomes.back().result));

    std::vector<Probe> open;
    for (std::size_t k = 0; k < probes.size(); ++k) {
      const RunResult &fine = outcomes[2 * k].result, &coarse = outcomes[2 * k + 1].result;
      const DiscretisationError found = grid_convergence(fine, coarse);
      const double error = std::max(found.force, counted(found.restitution, fine.summary.restitution));
      if (error > options_.tolerance) {
        open.push_back(probes[k]), reached = error;
        continue;
      }
      *probes[k].resolution = resolution;
      c.solver_error_force = std::max(c.solver_error_force, found.force);
      c.solver_error_restitution = std::max(c.solver_error_restitution, found.restitution);
    }
    probes = open;
    if (probes.empty()) {
      if (body_.yields() && !known_ && press_cells_ > resolutions[0]) elastic_ = elastic_correction();
      return;
    }
  }
  fail("--tolerance", "not reached at the finest resolution: two resolutions still differ",
       fmt::format("{:.2g}", reached), fmt::format("{:.2g} or more", reached));
}

RunJob Build::elastic_press() const
{
  return press_job(body_.elastic(), elastic_press_of(body_, press_cells_), source_);
}

ElasticCorrection Build::elastic_correction()
{
  const RunOutcome outcome = run({elastic_press()}, done_ + 0.05)[0];
  if (outcome.failed()) fail("mpm table", "the elastic press fails: " + outcome.error);
  return fit_elastic(contact_record_of(outcome.result));
}

/// The onset foreseen for a body of several materials is an estimate: a run that reversed before it and lost
/// energy has yielded.
void Build::heed_early_yield(const ContactRecords& records)
{
  constexpr double lost = 0.01;  // of the work: the waves that a slow elastic run leaves in the body are less
  for (const ContactRecord& p : records.slow)
    if (p.work_ratio < 1 - lost) body_.onset = std::min(body_.onset, 0.7 * p.depth);
}

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

FittedShape Build::fit(const ContactRecords& records, const std::optional<OnsetSimilarity>& guide) const
{
  if (known_) {
    FittedShape fitted{*known_, {}};
    fitted.shape.velocity_effects = fit_velocity_effects(records.fast, *known_, body_.onset, shape_end());
    return fitted;
  }
  if (!guide) return fit_shape(records, elastic_, body_.onset, options_.depth);
  const LawShape shape = guide->shape(elastic_);
  return fit_shape(records, elastic_, body_.onset, options_.depth, &shape, guide->end());
}

/// Error of e at the k-th reversal point of the law fitted without it, as it counts.
double held_out(const FittedShape& fitted, const ContactRecords& records, std::size_t k)
{
  return counted(fitted.quality.held_out_each[k], std::sqrt(std::max(0.0, records.slow[k].work_ratio)));
}

/// Halves the neighbourhood of what the law fitted without it was wrong about. `tried_overlaps` and
/// `tried_speeds` are not asked for again.
SamplingPlan Build::refinement(const FittedShape& fitted, const ContactRecords& records,
                               const std::vector<double>& tried_overlaps,
                               const std::vector<double>& tried_speeds) const
{
  SamplingPlan more;
  std::vector<double> overlaps;
  for (std::size_t k = 0; k < records.slow.size(); ++k) {
    if (held_out(fitted, records, k) <= options_.tolerance) continue;
    for (const std::size_t other : {k - 1, k + 1})
      if (other < records.slow.size()) {
        const double middle = std::sqrt(records.slow[k].depth * records.slow[other].depth);
        if (is_new(middle, tried_overlaps) && is_new(middle, overlaps)) overlaps.push_back(middle);
      }
  }
  std::sort(overlaps.begin(), overlaps.end());
  for (std::size_t k = overlaps.size(); k-- > 0;) {
    if (overlaps[k] < 1e-3) {
      more.slow_impacts.push_back(velocity_to(overlaps[k], body_));
    } else if (more.presses.empty() || more.presses.back().depth > 4 * overlaps[k]) {
      more.presses.push_back(
          {overlaps[k], {}, press_cells_, 2, loading_ramp(slow_, overlaps[k], options_.tolerance)});
    } else if (auto& stops = more.presses.back().stops;
               overlaps[k] < 0.88 * (stops.empty() ? more.presses.back().depth : stops.front())) {
      stops.insert(stops.begin(), overlaps[k]);
    }
  }
  more.fast_speeds = more_speeds(fitted.shape.velocity_effects, records.fast, tried_speeds);
  return more;
}

/// Speeds half-way to the neighbours of each impact whose e, or of a rate-dependent body also force at the
/// turn, is not as its neighbours would have it: even steps, a rate in the logarithm.
std::vector<double> Build::more_speeds(const std::vector<LawShape::VelocityEffect>& found,
                                       const std::vector<ContactRecords::Impact>& impacts,
                                       const std::vector<double>& tried) const
{
  const bool rate = body_.rate_dependent();
  const auto coordinate = [&](double speed) { return rate ? std::log(speed) : speed; };
  std::vector<double> more;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    if (k + 1 == impacts.size() || (rate && k == 0)) continue;  // that would be extrapolation
    std::vector<double> nodes, dissipation, force;
    if (!rate) nodes = dissipation = force = {0.0};  // at standstill
    for (std::size_t j = 0; j < impacts.size(); ++j)
      if (j != k) {
        nodes.push_back(coordinate(impacts[j].speed));
        dissipation.push_back(found[j].dissipation), force.push_back(found[j].force.back());
      }
    const auto weights = interpolation_weights(nodes, coordinate(impacts[k].speed));
    const auto told = [&](const std::vector<double>& values) {
      return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
    };
    double wrong = counted(0.5 * std::abs(told(dissipation) - found[k].dissipation),
                           std::sqrt(std::max(0.0, impacts[k].path.work_ratio)));
    if (rate) wrong = std::max(wrong, std::abs(told(force) - found[k].force.back()));
    if (wrong <= options_.tolerance) continue;
    const double here = impacts[k].speed, before = k ? impacts[k - 1].speed : 0.0,
                 after = impacts[k + 1].speed;
    const auto middle = [&](double a, double b) { return rate ? std::sqrt(a * b) : 0.5 * (a + b); };
    for (const double speed : {middle(before, here), middle(here, after)})
      if (speed > (rate ? 0.0 : 0.01) && is_new(speed, tried) && is_new(speed, more)) more.push_back(speed);
  }
  return more;
}

/// Replays the law against impacts that took no part in it, at these sqrt(I).
void Build::verify(const std::vector<double>& speeds)
{
  std::vector<RunJob> jobs;
  for (const double v : speeds)
    jobs.push_back(impact_job(body_, v * std::sqrt(body_.yield), impact_cells_, fast_shifted_grids, source_));
  const std::vector<RunOutcome> outcomes = run(jobs, 1.0);
  Certificate& c = law_.certificate;
  const LawMaterial& m = law_.material;
  const Scales unit{body_.scale.length, m.e_star(), m.density};
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (outcomes[k].failed()) continue;
    const RunSummary& run = outcomes[k].result.summary;
    const Replay replay = replay_on_wall(law_, unit.length, body_.mass * unit.mass(),
                                         speeds[k] * std::sqrt(body_.yield) * unit.velocity());
    const double force = std::abs(replay.force_max / unit.force() / run.force_max - 1),
                 e = std::abs(replay.restitution / run.restitution - 1);
    c.verification_error_force = std::max(c.verification_error_force, force);
    c.verification_error_restitution = std::max(c.verification_error_restitution, e);
    built_.sampling_error = std::max({built_.sampling_error, force, counted(e, run.restitution)});
    c.verification_impacts += 1;
  }
}

void Build::elastic()
{
  Certificate& c = law_.certificate;
  choose_resolutions({{[&](int cells) {
                         return press_job(body_, {options_.depth, {}, cells, 2}, source_);
                       },
                       &press_cells_}});
  std::vector<RunJob> jobs;
  for (const double share : {0.15, 1.0})  // the contact of the deep press begins with too few cells
    jobs.push_back(press_job(body_, {share * options_.depth, {}, press_cells_, 2}, source_));
  std::vector<ContactRecord> presses;
  for (const RunOutcome& outcome : run(jobs, 1.0)) {
    if (outcome.failed()) fail("mpm table", "the elastic press fails: " + outcome.error);
    presses.push_back(contact_record_of(outcome.result));
  }
  const ElasticFit fit = fit_elastic(presses);
  law_.curve = ContactCurve(tabulate_elastic(fit.correction, options_.depth), law_.material.name);
  c.interpolation_error = fit.error;
  double sum = 0;
  int count = 0;
  for (const auto& [x, f, a] : presses.back().loading)
    if (x > 0.5 * presses.back().depth) sum += std::pow(f / law_.curve.loading(x).force - 1, 2), ++count;
  c.residual_scatter = count ? std::sqrt(sum / count) : 0;
  c.damage_number_max = std::numeric_limits<double>::infinity();
  built_.runs_full = built_.runs;
}

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

/// The runs to begin with: two reversal points a press, few impacts.
SamplingPlan Build::first_plan() const
{
  SamplingRange range = widest_range();
  range.stops = 2;
  range.speeds = coarse_speeds;
  SamplingPlan plan = plan_sampling(slow_, range);
  // The fastest asked for is always run: nothing may be extrapolated.
  if (options_.fastest > 0 && (plan.fast_speeds.empty() || plan.fast_speeds.back() < options_.fastest))
    plan.fast_speeds.push_back(options_.fastest);
  if (body_.rate_dependent())
    plan.fast_speeds = by_factors(slowest_of(body_, options_), options_.fastest, rate_factor);
  return plan;
}

/// How many runs the densest plan has.
std::size_t Build::most_runs(const std::optional<OnsetSimilarity>& guide) const
{
  SamplingPlan full = plan_sampling(slow_, widest_range());
  if (body_.rate_dependent())
    full.fast_speeds = by_factors(slowest_of(body_, options_), options_.fastest, std::sqrt(rate_factor));
  std::size_t runs = full.runs();
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
  run(parts, done_ + 0.7 * (0.9 - done_));
}

/// Runs and fits until nothing that is left out of the fit is missed by more than the tolerance.
Build::Sampled Build::sample(SamplingPlan plan, std::optional<OnsetSimilarity>& guide)
{
  Sampled sampled;
  std::vector<double> tried_overlaps, tried_speeds;
  for (int round = 0; round < most_rounds && plan.runs() > 0; ++round) {
    run_round(plan, sampled.records, guide && round == 0 ? &guide->spheres() : nullptr);
    if (!body_.particle.is_homogeneous_sphere()) heed_early_yield(sampled.records);
    sampled.fitted = fit(sampled.records, guide);
    for (const ContactRecord& p : sampled.records.slow) tried_overlaps.push_back(p.depth);
    for (const ContactRecords::Impact& i : sampled.records.fast) tried_speeds.push_back(i.speed);
    plan = refinement(sampled.fitted, sampled.records, tried_overlaps, tried_speeds);
  }
  return sampled;
}

/// What the runs and their fit say of the law's errors.
void Build::certify(const Sampled& sampled)
{
  Certificate& c = law_.certificate;
  c.damage_number_max = options_.fastest * options_.fastest;
  c.reload_loop_area = sampled.records.reload_loop;
  c.residual_scatter = sampled.fitted.quality.scatter;
  c.held_out_error = sampled.fitted.quality.held_out;
  if (known_) {
    built_.rate_free = "from the atlas";
    c.atlas_error_force = options_.atlas->claimed_force();
    c.atlas_error_restitution = options_.atlas->claimed_restitution();
  }
  for (std::size_t k = 0; k < sampled.records.slow.size(); ++k)
    built_.sampling_error = std::max(built_.sampling_error, held_out(sampled.fitted, sampled.records, k));
}

/// sqrt(I) between those of the runs, up to where the law's axis ends.
std::vector<double> Build::verification_speeds(const ContactRecords& records) const
{
  const double fastest = std::sqrt(law_.certificate.damage_number_max);
  std::vector<double> speeds;
  if (body_.rate_dependent()) {
    const double slowest = records.fast.front().speed;
    for (const double share : {0.1, 0.37, 0.63, 0.9})
      speeds.push_back(slowest * std::pow(fastest / slowest, share));
  } else {
    for (const double share : {0.13, 0.42, 0.88}) speeds.push_back(share * fastest);
  }
  return speeds;
}

void Build::plastic()
{
  require_lawful();
  SamplingPlan plan = first_plan();
  const double first = plan.slow_impacts.empty() ? plan.presses.front().stops.front()
                                                 : expected_depth(plan.slow_impacts.front(), slow_);
  if (known_) plan.presses.clear(), plan.slow_impacts.clear();
  choose_resolutions(probes(plan));
  for (SamplingPlan::Press& press : plan.presses) press.resolution = std::max(press.resolution, press_cells_);
  std::optional<OnsetSimilarity> guide = onset_similarity(first);
  // the first impact would show what is known then, for a third of the time
  if (guide && guide->spares_first() && !plan.slow_impacts.empty())
    plan.slow_impacts.erase(plan.slow_impacts.begin());

  built_.runs = 0;
  const Sampled sampled = sample(plan, guide);
  built_.runs_full = most_runs(guide);
  if (guide) built_.shallow = guide->how();

  certify(sampled);
  const LawShape& shape = sampled.fitted.shape;
  law_.certificate.interpolation_error = finish_curve(law_, shape, body_, options_, shape_end());
  built_.change_of_restitution = change_of_restitution(shape, body_.onset, shape_end(), law_.curve);
  if (options_.fastest > 0) verify(verification_speeds(sampled.records));
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

BodyLaw law_from(const Atlas& atlas, const LawMaterial& material, const BuildOptions& options)
{
  check(options);
  BodyLaw law;
  law.material = material;
  Certificate& c = law.certificate;
  c.origin = "atlas";
  if (!material.yields()) {
    const ElasticSphere sphere = atlas.elastic(material.poisson_ratio);
    const double depth = std::min(options.depth, ElasticSphere::depth);
    law.curve = ContactCurve(tabulate_elastic(sphere.fit.correction, depth), material.name);
    c.damage_number_max = std::numeric_limits<double>::infinity();
    c.atlas_error_force = sphere.fit.error;  // e is 1
    c.solver_error_force = sphere.solver_error;
    return law;
  }
  const MaterialRatios ratios = MaterialRatios::of(material);
  if (const std::string why = atlas.why_not(ratios); !why.empty())
    fail(fmt::format("material '{}'", material.name), "is not in the atlas: " + why);
  const CharacterisedBody body =
      characterised_body_of(ratios.stiffness, ratios.poisson_ratio, ratios.hardening);
  c.damage_number_max = options.fastest * options.fastest;
  c.interpolation_error = finish_curve(law, atlas.shape(ratios), body, options, Atlas::depth);
  c.atlas_error_force = atlas.claimed_force();
  c.atlas_error_restitution = atlas.claimed_restitution();
  c.solver_error_force = c.solver_error_restitution = atlas.solver_error();
  return law;
}

double support_ratio(double overlap)
{
  // measured, E*/Y = 100, nu = 0.3 (docs/method.md)
  const std::vector<double> overlaps{0, 0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3};
  const std::vector<double> ratios{1, 1.012, 1.025, 1.030, 1.044, 1.092, 1.438, 1.638};
  const auto above = std::upper_bound(overlaps.begin(), overlaps.end(), overlap) - overlaps.begin();
  if (above == static_cast<std::ptrdiff_t>(overlaps.size())) return ratios.back();
  const auto k = static_cast<std::size_t>(above);
  const double t = (overlap - overlaps[k - 1]) / (overlaps[k] - overlaps[k - 1]);
  return ratios[k - 1] + t * (ratios[k] - ratios[k - 1]);
}

}  // namespace granulaw
