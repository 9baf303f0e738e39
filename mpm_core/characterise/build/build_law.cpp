#include "characterise/build/build_law.hpp"

#include "characterise/run/sampling_plan.hpp"

#include "characterise/run/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "characterise/build/adaptive_sampling.hpp"
#include "atlas/finish_curve.hpp"
#include "characterise/fit/fit_curve.hpp"
#include "characterise/run/onset_of_yield.hpp"
#include "atlas/guide.hpp"
#include "atlas/overlap_at_work.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/run/refinement.hpp"
#include "characterise/run/resolution_choice.hpp"
#include "atlas/tabulate_curve.hpp"
#include "characterise/build/verification.hpp"

namespace granulaw {

namespace {

/// Onset of yield over the law's depth: later, too little of the law is left to be fitted.
constexpr double latest_onset = 0.2;

/// sqrt(I) of the slowest impact on a rate axis.
double slowest_of(const CharacterisedBody& body, const BuildOptions& o)
{
  const double onset = onset_velocity(1.0, body.yield, 1.0, body.poisson_ratio) / std::sqrt(body.yield);
  const double wanted = o.slowest > 0 ? o.slowest : o.fastest / 50;
  return std::min(std::max(wanted, onset), 0.5 * o.fastest);
}

/// rms of a press's loading force about a curve, over the upper half of its overlaps.
double scatter_about(const Curve& curve, const ContactRecord& press)
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

/// One build: what it shares between its steps.
class Build
{
 public:
  Build(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
        const RunSource& source);
  void elastic();
  void plastic();
  BuiltLaw take();
  void require_reachable() const;
  ExpectedRuns expected() const;

 private:
  void require_lawful() const;
  double least_onset() const;
  std::optional<Guide> guide(const ElasticCorrection* elastic) const;
  SamplingPlan first_plan() const;

  void resolve(const SamplingPlan& plan);
  std::vector<Probe> probes(const SamplingPlan& plan);
  void find_onset();
  void note_solver_error(const ResolutionChoice& choice);

  void certify(const Sampled& sampled);
  double slowest_verification(double first) const;
  void verify_impacts(const ContactRecords& records);

  BuiltLaw built_;
  BodyLaw& law_ = built_.law;
  CharacterisedBody body_;  ///< its onset is that of the elastic press
  CharacterisedBody slow_;  ///< the body without rate: its law is the rate-independent one, the velocity axis
                            ///< brings the rate in
  const BuildOptions& options_;
  const RunSource& source_;
  BuildRuns runs_;
  std::optional<PoleMaterial> pole_;  ///< with a guide
  bool known_ = false;  ///< the guide is a rate-dependent body's rate-independent law
  ElasticCorrection elastic_;
  std::optional<ContactRecord> elastic_press_;  ///< of a body of several materials
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
  if (!options.atlas || !body.yields()) return;
  const Material& at_pole = body.particle.materials[static_cast<std::size_t>(body.pole_material)];
  PoleMaterial pole{MaterialRatios::of(law_material("", at_pole))};
  if (!at_pole.hardening.name.empty()) pole.flow = flow_curve(at_pole), pole.ratios.hardening = 0;
  if (!why_no_guide(*options.atlas, pole).empty()) return;
  pole_ = pole;
  known_ = body.rate_dependent() && slow_.is_plain() && options.tolerance >= guide({})->error_force;
}

/// By this elastic correction; a sphere's is the atlas's.
std::optional<Guide> Build::guide(const ElasticCorrection* elastic) const
{
  if (!pole_) return {};
  if (body_.particle.is_homogeneous_sphere()) elastic = nullptr;
  return guide_of(*options_.atlas, *pole_, body_.onset, known_ ? Atlas::depth : options_.depth, elastic);
}

BuiltLaw Build::take()
{
  built_.holes = runs_.holes();
  return std::move(built_);
}

// -- plan --

/// Least onset: the guide reaches from there to the first run; without a guide an impact to 2e-6 R takes minutes.
double Build::least_onset() const
{
  constexpr double without_guide = 1e-6;
  if (!pole_) return without_guide;
  const MaterialRatios stiffest{options_.atlas->grid().stiffnesses.back(), body_.poisson_ratio, 0};
  return onset_of(stiffest) * shallowest_with_guide / Atlas::depth;
}

void Build::require_lawful() const
{
  const std::string where = fmt::format("material '{}'", law_.material.name);
  if (body_.onset > latest_onset * options_.depth)
    fail(where, "yields too late in the overlaps that a law covers",
         fmt::format("onset at delta/R = {:.3g}", body_.onset),
         fmt::format("up to {:.3g}", latest_onset * options_.depth));
  if (const double least = least_onset(); body_.onset < least)
    fail(where, "yields at overlaps too small to be run", fmt::format("onset at delta/R = {:.2g}", body_.onset),
         fmt::format("{:.2g} or more", least));
  if (body_.rate_dependent() && options_.fastest == 0)
    fail(where, "depends on the rate: its law needs impacts, not the quasi-static law alone", "I = 0",
         "over 0");
}

/// The runs to begin with.
SamplingPlan Build::first_plan() const
{
  SamplingPlan plan;
  if (!known_)
    plan = slow_runs_to(first_overlaps(body_.onset, options_.depth, pole_.has_value()), slow_, options_.tolerance, press_cells_,
                        pole_ ? slow_with_guide : slow_without);
  if (body_.rate_dependent())
    plan.fast_speeds = first_rate_speeds(slowest_of(body_, options_), options_.fastest);
  else if (options_.fastest > 0)
    plan.fast_speeds = first_inertia_speeds(options_.fastest, options_.tolerance);
  return plan;
}

// -- resolve --

/// Runs that show the error of a plan: a fast impact, which rings and may need more cells than a press,
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

void Build::note_solver_error(const ResolutionChoice& choice)
{
  law_.certificate.solver_error_force = choice.error.force;
  law_.certificate.solver_error_restitution = choice.error.restitution;
}

/// The elastic press determines the onset of yield of a body of several materials, or with pores, so it comes
/// first. If it was not deep enough, a second one goes as deep as a law's onset may be.
void Build::find_onset()
{
  if (body_.is_uniform()) return;
  const auto press = [&](double depth) {
    const RunJob job = elastic_press_job(body_, first_resolution, source_, depth);
    return runs_.make_needed({job}, runs_.done(), "the elastic press").front().result;
  };
  const RunResult first = press(0);
  elastic_press_ = contact_record_of(first);
  elastic_ = fit_elastic(*elastic_press_);
  body_.onset = onset_of_yield(body_, first);
  const double latest = latest_onset * options_.depth;
  if (std::isinf(body_.onset) && first.summary.delta_max < latest)
    body_.onset = onset_of_yield(body_, press(latest));
  slow_.onset = body_.onset;
}

/// The resolution of each kind of run, and the elastic correction at that of the presses.
void Build::resolve(const SamplingPlan& plan)
{
  std::vector<RunJob> beside;
  const bool of_atlas = pole_ && body_.particle.is_homogeneous_sphere();
  if (of_atlas) elastic_ = guide({})->master.elastic;
  if (!of_atlas && body_.is_uniform()) beside.push_back(elastic_press_job(body_, first_resolution, source_));
  const ResolutionChoice choice = choose_resolutions(probes(plan), beside, options_.tolerance, runs_);
  note_solver_error(choice);
  if (!beside.empty()) elastic_ = fit_elastic(contact_record_of(choice.beside.front().result));
  if (of_atlas || press_cells_ == first_resolution) return;
  const RunJob finer = elastic_press_job(body_, press_cells_, source_);
  const RunOutcome press = runs_.make_needed({finer}, runs_.done() + 0.05, "the elastic press").front();
  if (elastic_press_) elastic_press_ = contact_record_of(press.result);
  elastic_ = fit_elastic(contact_record_of(press.result));
}

// -- certify, tabulate, verify --

/// Errors of the law by its runs and their fit.
void Build::certify(const Sampled& sampled)
{
  Certificate& c = law_.certificate;
  c.damage_number_max = options_.fastest * options_.fastest;
  c.reload_loop_area = sampled.records.reload_loop;
  c.residual_scatter = sampled.fitted.quality.scatter;
  c.held_out_error = largest_errors(sampled.slow).restitution;
  built_.sampling_error = largest_miss(sampled.slow);
  if (!known_) return;
  built_.rate_free = "from the atlas";
  c.atlas_error_force = options_.atlas->claimed_force();
  c.atlas_error_restitution = options_.atlas->claimed_restitution();
}

/// sqrt(I) of an impact half-way between the onset and the shallowest run, where layers show.
double Build::slowest_verification(double first) const
{
  const double overlap = std::sqrt(body_.onset * first);
  return std::sqrt(law_.curve.work(overlap) / energy_unit(body_.mass, body_.yield));
}

void Build::verify_impacts(const ContactRecords& records)
{
  constexpr std::size_t of_inertia = 3, of_rate = 4;  // impacts; a rate's axis is the longer one
  const double fastest = std::sqrt(law_.certificate.damage_number_max);
  std::vector<double> speeds = verification_speeds(records.fast, fastest, axis_kind_of(body_),
                                                   body_.rate_dependent() ? of_rate : of_inertia);
  if (!body_.is_uniform()) speeds.insert(speeds.begin(), slowest_verification(records.slow.front().depth));
  const double error = verify(law_, body_, speeds, impact_cells_, source_, runs_);
  built_.sampling_error = larger(built_.sampling_error, error);
}

void Build::require_reachable() const
{
  if (!body_.yields() || !body_.is_uniform()) return;  // else a press gives the onset
  require_lawful();
}

ExpectedRuns Build::expected() const
{
  if (!body_.yields()) return {2, 2 * press_job(body_, {options_.depth, {}, press_cells_, 2}, source_).cost};
  const SamplingPlan plan = first_plan();
  ExpectedRuns expected{plan.runs(), 0};
  for (const RunJob& job : sampling_jobs(slow_, plan, source_)) expected.first_cpu_s += job.cost;
  return expected;
}

void Build::plastic()
{
  find_onset();
  require_lawful();
  SamplingPlan plan = first_plan();
  resolve(plan);
  for (SamplingPlan::Press& press : plan.presses) press.resolution = press_cells_;
  const std::size_t before = runs_.count();
  const auto guide_by = [this](const ElasticCorrection& elastic) -> std::optional<LawShape> {
    const std::optional<Guide> found = guide(&elastic);
    if (found) return found->master;
    return {};
  };
  const SamplingSetting setting{body_, slow_, options_, source_, elastic_, elastic_press_ ? &*elastic_press_ : nullptr,
                                press_cells_, impact_cells_, guide_by, known_};
  const Sampled sampled = sample(plan, setting, runs_);
  if (const auto found = guide(&elastic_)) built_.guide = found->from;

  certify(sampled);
  const LawShape& shape = sampled.fitted.shape;
  law_.certificate.interpolation_error = finish_curve(law_, shape, numbers_of(body_), options_);
  built_.change_of_restitution = change_of_restitution(shape, law_.curve);
  if (options_.fastest > 0) verify_impacts(sampled.records);
  law_.state();
  leave_out_axis(law_, collision_on_wall(numbers_of(body_)), options_.tolerance);
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
  law_.curve = tabulate({fit.correction, options_.depth});
  Certificate& c = law_.certificate;
  c.interpolation_error = fit.error;
  c.residual_scatter = scatter_about(law_.curve, presses.back());
  c.damage_number_max = std::numeric_limits<double>::infinity();
  law_.state();
  built_.runs = runs_.count();
}

}  // namespace

void require_reachable(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options)
{
  const RunSource source;
  Build(material, body, options, source).require_reachable();
}

ExpectedRuns expected_runs(const LawMaterial& material, const CharacterisedBody& body,
                           const BuildOptions& options)
{
  const RunSource source;
  return Build(material, body, options, source).expected();
}

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

BuiltLaw build_law(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options)
{
  return build_law(material, body, options, RunSource{});
}

BuiltLaw build_law(const std::string& name, const Particle& particle, const BuildOptions& options)
{
  const CharacterisedBody body = characterised_body_of(particle);
  LawMaterial material =
      law_material(name, particle.materials[static_cast<std::size_t>(body.pole_material)]);
  if (body.yields()) material.yield_stress = body.yield * body.scale.stress;
  return build_law(material, body, options);
}

Curve slow_law_by_runs(const std::string& name, const Material& material, double depth, const Atlas& atlas, Farm& farm,
                       const Progress& progress)
{
  BuildOptions options;
  options.depth = depth, options.fastest = 0;
  options.atlas = &atlas, options.farm = &farm, options.progress = progress;
  return build_law(law_material(name, material), characterised_body_of(material), options).law.curve;
}

}  // namespace granulaw
