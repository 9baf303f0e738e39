#include "characterise/atlas_build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/law_from_atlas.hpp"
#include "characterise/fit_curve.hpp"
#include "characterise/interpolation.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr double elastic_depth = 0.03;  // overlap/R of the presses that tell the finite-sphere correction

std::vector<MaterialRatios> all_materials(const AtlasGrid& grid)
{
  std::vector<MaterialRatios> all = grid.main_plane();
  const std::vector<MaterialRatios> block = grid.block();
  all.insert(all.end(), block.begin(), block.end());
  return all;
}

CharacterisedBody sphere_of(const MaterialRatios& m)
{
  return characterised_body_of(m.stiffness, m.poisson_ratio, m.hardening);
}

double onset_of(const MaterialRatios& m)
{
  return sphere_of(m).onset;
}

/// A slow press without yield, for the finite-sphere correction.
RunJob elastic_job(double poisson_ratio, double depth, const RunSource& source)
{
  return press_job(characterised_body_of(1.0, poisson_ratio, 0.0).elastic(), {depth, {}, 24, 2}, source);
}

/// Of a material that is known, else null.
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
  SamplingPlan plan = plan_sampling(sphere_of(m), {});
  plan.ringing_resolution = 36;
  if (shape_in(known, m)) {
    plan.presses.clear(), plan.slow_impacts.clear();
    if (!known.impacts_anew) plan.fast_speeds.clear();
  }
  return plan;
}

/// Functions of u are brought to the same delta/delta_onset in another material's range.
LawShape at_range_of(const MaterialRatios& to, const MaterialRatios& from, const LawShape& shape)
{
  const double share = std::log(Atlas::depth / onset_of(to)) / std::log(Atlas::depth / onset_of(from));
  return shape.rescaled(share);
}

}  // namespace

std::vector<RunJob> atlas_jobs(const AtlasGrid& grid, const RunSource& source, const KnownAtlas& known)
{
  std::vector<RunJob> jobs;
  for (const double nu : grid.poisson_ratios()) {
    jobs.push_back(elastic_job(nu, elastic_depth, source));
    jobs.push_back(with_estimate(elastic_job(nu, ElasticSphere::depth, source)));
  }
  for (const MaterialRatios& m : all_materials(grid)) {
    for (RunJob& job : sampling_jobs(sphere_of(m), plan_for(m, known), source)) {
      job.label = fmt::format("E*/Y {:g}, nu {:g}, H/E {:g}: {}", m.stiffness, m.poisson_ratio, m.hardening,
                              job.label);
      jobs.push_back(std::move(job));
    }
  }
  return jobs;
}

Atlas atlas_from(const AtlasGrid& grid, const std::vector<RunOutcome>& outcomes, const KnownAtlas& known)
{
  std::size_t next = 0;
  std::vector<ElasticCorrection> elastic;  // where yield comes first
  std::vector<ElasticSphere> spheres;
  const std::vector<double> ratios = grid.poisson_ratios();
  for (const double nu : ratios) {
    const ContactRecord shallow = contact_record_of(outcomes[next++].result);
    const RunResult& deep = outcomes[next++].result;
    elastic.push_back(fit_elastic(shallow));
    spheres.push_back(
        {nu, fit_elastic(std::vector{shallow, contact_record_of(deep)}), deep.summary.error_estimate});
  }
  const auto elastic_at = [&](double nu) {
    return elastic[static_cast<std::size_t>(std::find(ratios.begin(), ratios.end(), nu) - ratios.begin())];
  };

  std::vector<Atlas::Node> nodes;
  /// Shape of a material from the nodes made so far at one stiffness of the main plane.
  const auto main_shape = [&](double stiffness, double hardening) {
    std::vector<double> z;
    std::vector<const LawShape*> shapes;
    for (const Atlas::Node& node : nodes)
      if (node.material.stiffness == stiffness && node.material.poisson_ratio == grid.main_poisson_ratio) {
        z.push_back(hardening_coordinate(stiffness, node.material.hardening));
        shapes.push_back(&node.shape);
      }
    const auto weights = interpolation_weights(z, hardening_coordinate(stiffness, hardening));
    LawShape sum = LawShape::zero();
    for (std::size_t k = 0; k < shapes.size(); ++k)
      if (weights[k] != 0) sum.add(weights[k], *shapes[k]);
    return sum;
  };

  const auto onset_similarity = [&](const MaterialRatios& m) -> LawShape {
    const auto main_at_range = [&](double stiffness) {
      const MaterialRatios from{stiffness, grid.main_poisson_ratio, m.hardening};
      return at_range_of(m, from, main_shape(stiffness, m.hardening));
    };
    if (m.poisson_ratio == grid.main_poisson_ratio) {
      const auto at = std::find(grid.stiffnesses.begin(), grid.stiffnesses.end(), m.stiffness);
      if (at - grid.stiffnesses.begin() < 2)
        fail("atlas", "its two least stiff materials must yield above the shallowest runs");
      return linear_in_yield_ratio(m.stiffness, at[-1], main_at_range(at[-1]), at[-2], main_at_range(at[-2]));
    }
    // the same stiffness in the main plane, and what Poisson's ratio changes at the block's next less stiff
    const auto at = std::find(grid.block_stiffnesses.begin(), grid.block_stiffnesses.end(), m.stiffness);
    if (at == grid.block_stiffnesses.begin())
      fail("atlas", "its block's least stiff material must yield above the shallowest runs");
    const double below = at[-1];
    LawShape guide = main_at_range(m.stiffness);
    guide.add(-1, main_at_range(below));
    for (const Atlas::Node& node : nodes)
      if (node.material.stiffness == below && node.material.poisson_ratio == m.poisson_ratio &&
          node.material.hardening == m.hardening)
        guide.add(1, at_range_of(m, node.material, node.shape));
    return guide;
  };

  for (const MaterialRatios& m : all_materials(grid)) {
    const SamplingPlan plan = plan_for(m, known);
    const auto first = outcomes.begin() + static_cast<std::ptrdiff_t>(next);
    ContactRecords records;
    add_to(records, plan, {first, first + static_cast<std::ptrdiff_t>(plan.runs())});
    next += plan.runs();
    if (const LawShape* shape = shape_in(known, m)) {
      nodes.push_back({m, *shape});
      if (known.impacts_anew)
        nodes.back().shape.velocity_effects =
            fit_velocity_effects(records.fast, *shape, onset_of(m), Atlas::depth);
      continue;
    }
    const bool begins_late = records.slow.front().depth > 2 * onset_of(m);
    const LawShape guide = begins_late ? onset_similarity(m) : LawShape::zero();
    nodes.push_back({m, fit_shape(records, elastic_at(m.poisson_ratio), onset_of(m), Atlas::depth,
                                  begins_late ? &guide : nullptr)
                            .shape});
  }
  return Atlas(grid, std::move(nodes), std::move(spheres));
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
    BuildOptions options;
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
