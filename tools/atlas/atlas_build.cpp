#include "atlas_build.hpp"

#include "material_runs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/fit/fit_curve.hpp"
#include "atlas/interpolation.hpp"
#include "atlas/law_from_atlas.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr double elastic_depth = 0.03;  // overlap/R of the presses that give the finite-sphere correction

/// A slow press without yield, for the finite-sphere correction.
RunJob elastic_job(double poisson_ratio, double depth, const RunSource& source)
{
  return press_job(characterised_body_of(1.0, poisson_ratio, 0.0).elastic(), {depth, {}, 24, 2}, source);
}

/// Shape of a known material, else null.
const LawShape* shape_in(const KnownAtlas& known, const MaterialRatios& m)
{
  if (!known.atlas) return nullptr;
  for (const Atlas::Node& node : known.atlas->nodes())
    if (node.material == m) return &node.shape;
  return nullptr;
}

/// The runs of a material, but for what is known of it.
SamplingPlan plan_for(const MaterialRatios& m, const KnownAtlas& known)
{
  SamplingPlan plan = plan_sampling(sphere_of(m));
  plan.ringing_resolution = 36;
  if (shape_in(known, m)) {
    plan.presses.clear(), plan.slow_impacts.clear();
    if (!known.impacts_anew) plan.fast_speeds.clear();
  }
  return plan;
}

}  // namespace

std::vector<RunJob> atlas_jobs(const AtlasGrid& grid, const RunSource& source, const KnownAtlas& known)
{
  std::vector<RunJob> jobs;
  for (const double nu : grid.poisson_ratios()) {
    jobs.push_back(elastic_job(nu, elastic_depth, source));
    jobs.push_back(with_estimate(elastic_job(nu, ElasticSphere::depth, source)));
  }
  for (const MaterialRatios& m : grid.materials()) add_jobs(jobs, m, plan_for(m, known), source);
  return jobs;
}

namespace {

/// An atlas that is being made: its elastic spheres, then its materials in the order of the grid.
class Assembly
{
 public:
  Assembly(const AtlasGrid& grid, const std::vector<RunOutcome>& outcomes, const KnownAtlas& known)
      : grid_(grid), outcomes_(outcomes), known_(known), ratios_(grid.poisson_ratios())
  {
  }
  void add_elastic_spheres();
  void add(const MaterialRatios& m);
  Atlas take() { return Atlas(grid_, std::move(nodes_), std::move(spheres_)); }

 private:
  LawShape fitted(const MaterialRatios& m, const ContactRecords& records) const;
  LawShape main_shape(double stiffness, double hardening) const;
  LawShape main_at(double onset, double stiffness, double hardening) const;
  LawShape known_in_main_plane(const MaterialRatios& m) const;
  LawShape known_in_block(const MaterialRatios& m) const;

  const AtlasGrid& grid_;
  const std::vector<RunOutcome>& outcomes_;
  const KnownAtlas& known_;
  const std::vector<double> ratios_;        // Poisson's
  std::size_t next_ = 0;                    // outcome
  std::vector<ElasticCorrection> elastic_;  // by ratios_, where yield comes first
  std::vector<ElasticSphere> spheres_;
  std::vector<Atlas::Node> nodes_;
};

void Assembly::add_elastic_spheres()
{
  for (const double nu : ratios_) {
    const ContactRecord shallow = contact_record_of(outcomes_[next_++].result);
    const RunResult& deep = outcomes_[next_++].result;
    elastic_.push_back(fit_elastic(shallow));
    spheres_.push_back(
        {nu, fit_elastic(std::vector{shallow, contact_record_of(deep)}), deep.summary.error_estimate});
  }
}

void Assembly::add(const MaterialRatios& m)
{
  const ContactRecords records = records_of(m, plan_for(m, known_), outcomes_, next_);
  const LawShape* shape = shape_in(known_, m);
  nodes_.push_back({m, shape ? *shape : fitted(m, records)});
  if (shape && known_.impacts_anew)
    nodes_.back().shape.velocity_effects =
        fit_velocity_effects(records.fast, *shape, onset_of(m), Atlas::depth);
}

LawShape Assembly::fitted(const MaterialRatios& m, const ContactRecords& records) const
{
  const auto ratio = std::find(ratios_.begin(), ratios_.end(), m.poisson_ratio) - ratios_.begin();
  const ElasticCorrection& elastic = elastic_[static_cast<std::size_t>(ratio)];
  const double onset = onset_of(m);
  // Up to twice the onset's overlap a fit that leaves the onset with zero slope follows the law.
  std::optional<LawShape> below;
  if (records.slow.front().depth > 2 * onset)
    below = m.poisson_ratio == grid_.main_poisson_ratio ? known_in_main_plane(m) : known_in_block(m);
  return fit_shape(records, elastic, onset, Atlas::depth, below ? &*below : nullptr).shape;
}

/// From the nodes made so far at one stiffness of the reference set.
LawShape Assembly::main_shape(double stiffness, double hardening) const
{
  std::vector<double> z;
  std::vector<const LawShape*> shapes;
  for (const Atlas::Node& node : nodes_)
    if (node.material.stiffness == stiffness && node.material.poisson_ratio == grid_.main_poisson_ratio) {
      z.push_back(hardening_coordinate(stiffness, node.material.hardening));
      shapes.push_back(&node.shape);
    }
  const auto weights = interpolation_weights(z, hardening_coordinate(stiffness, hardening));
  LawShape sum = LawShape::zero();
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (weights[k] != 0) sum.add(weights[k], *shapes[k]);
  return sum;
}

// Near the onset of yield a law is a function of overlap/onset, but for the finite body: a term in Y/E*, which goes
// as sqrt(onset/R), and one in its square (docs/develop/notes.md).

/// The law of the reference set at one stiffness, brought to another onset.
LawShape Assembly::main_at(double onset, double stiffness, double hardening) const
{
  LawShape shape = main_shape(stiffness, hardening);
  shape.onset = onset_of({stiffness, grid_.main_poisson_ratio, hardening}), shape.end = Atlas::depth;
  return shape.at_range(onset, Atlas::depth);
}

/// Linear in Y/E* through the next two less stiff materials.
LawShape Assembly::known_in_main_plane(const MaterialRatios& m) const
{
  const auto at = std::find(grid_.stiffnesses.begin(), grid_.stiffnesses.end(), m.stiffness);
  if (at - grid_.stiffnesses.begin() < 2)
    fail("atlas", "its two least stiff materials must yield above the shallowest runs");
  const double onset = onset_of(m);
  const LawShape stiffer = main_at(onset, at[-1], m.hardening), softer = main_at(onset, at[-2], m.hardening);
  const double slope = (1 / m.stiffness - 1 / at[-1]) / (1 / at[-1] - 1 / at[-2]);
  LawShape known = stiffer;
  known.add(slope, stiffer), known.add(-slope, softer);
  return known;
}

/// From the block's next less stiff material, and what stiffness changes in the reference set.
LawShape Assembly::known_in_block(const MaterialRatios& m) const
{
  const auto at = std::find(grid_.block_stiffnesses.begin(), grid_.block_stiffnesses.end(), m.stiffness);
  if (at == grid_.block_stiffnesses.begin())
    fail("atlas", "its block's least stiff material must yield above the shallowest runs");
  const MaterialRatios softer{at[-1], m.poisson_ratio, m.hardening};
  const auto made = std::find_if(nodes_.begin(), nodes_.end(),
                                 [&](const Atlas::Node& node) { return node.material == softer; });
  const double onset = onset_of(m);
  LawShape known = made->shape;
  known.onset = onset_of(softer), known.end = Atlas::depth;
  known = known.at_range(onset, Atlas::depth);
  known.add(1, main_at(onset, m.stiffness, m.hardening));
  known.add(-1, main_at(onset, softer.stiffness, m.hardening));
  return known;
}

}  // namespace

Atlas atlas_from(const AtlasGrid& grid, const std::vector<RunOutcome>& outcomes, const KnownAtlas& known)
{
  Assembly assembly(grid, outcomes, known);
  assembly.add_elastic_spheres();
  for (const MaterialRatios& m : grid.materials()) assembly.add(m);
  return assembly.take();
}

std::vector<AtlasCheck> check_atlas(const Atlas& atlas, Farm& farm, int count, unsigned seed,
                                    const Progress& progress)
{
  constexpr double least_overlap = 3e-4, fastest = 0.245;
  std::mt19937 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  const auto between = [&](double low, double high) { return low * std::pow(high / low, uniform()); };
  const AtlasGrid& grid = atlas.grid();
  const RunSource source;

  std::vector<AtlasCheck> checks;
  std::vector<Replay> said;
  std::vector<RunJob> jobs;
  while (static_cast<int>(checks.size()) < count) {
    AtlasCheck c;
    c.material.stiffness = between(grid.stiffnesses.front(), grid.stiffnesses.back());
    c.material.poisson_ratio = grid.block_poisson_ratios.back() * uniform();
    c.material.hardening = uniform() < 0.25 ? 0.0 : between(1e-3, grid.hardenings.back());
    const CharacterisedBody body = sphere_of(c.material);
    const double onset = onset_velocity(1.0, body.yield, 1.0, body.poisson_ratio) / std::sqrt(body.yield);
    c.speed = between(1.5 * onset, fastest);
    const double velocity = c.speed * std::sqrt(body.yield);
    const Material& m = body.particle.materials[0];
    LawRange options;
    options.depth = Atlas::depth;
    const BodyLaw law = law_from(
        atlas, {"check", m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus},
        options);
    const Replay replay = replay_on_wall(law, 1.0, body.mass, velocity);
    if (replay.delta_max < least_overlap) continue;
    checks.push_back(c);
    said.push_back(replay);
    RunJob job = with_estimate(impact_job(body, velocity, 0, RunOptions{}.shifted_grids, source));
    job.cost = 3;
    jobs.push_back(std::move(job));
  }
  const std::vector<RunResult> results = farm.run_all(jobs, progress);
  for (std::size_t k = 0; k < checks.size(); ++k) {
    const RunSummary& run = results[k].summary;
    checks[k].error_force = said[k].force_max / run.force_max - 1;
    checks[k].error_restitution = said[k].restitution - run.restitution;
    checks[k].solver_estimate = run.error_estimate;
  }
  return checks;
}

}  // namespace granulaw
