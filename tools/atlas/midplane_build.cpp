#include "midplane_build.hpp"

#include "material_runs.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "characterise/fit/fit_curve.hpp"
#include "law/contact_law.hpp"

namespace granulaw {

namespace {

constexpr double elastic_depth = 0.03;  // overlap/R of the presses that give the elastic correction
/// Overlap below which the series compliance gives all: no press is needed there.
constexpr double least_stop = 0.0075;
constexpr double press_depths[] = {0.03, 0.13, 0.5};
constexpr int stops = 3;  // partial unloadings a press
/// Overlap beyond which fewer cells and one grid will do, as in plan_sampling().
constexpr double many_cells_end = 0.2;

/// Presses to the three depths, as far as the material yields there.
SamplingPlan plan_for(const MaterialRatios& m)
{
  SamplingPlan plan;
  double done = std::max(least_stop, 1.25 * sphere_of(m).onset);
  for (const double depth : press_depths) {
    if (depth < 1.3 * done) continue;
    SamplingPlan::Press press{depth, {}, 24, 2};
    press.support = Support::midplane;
    for (int k = 0; k < stops; ++k)
      press.stops.push_back(done * std::pow(depth / done, static_cast<double>(k) / stops));
    if (depth > many_cells_end) press.resolution = 20, press.shifted_grids = 1;
    plan.presses.push_back(press);
    done = depth;
  }
  return plan;
}

RunJob elastic_job(double poisson_ratio, const RunSource& source)
{
  SamplingPlan::Press press{elastic_depth, {}, 24, 2};
  press.support = Support::midplane;
  return press_job(characterised_body_of(1.0, poisson_ratio, 0.0).elastic(), press, source);
}

LawShape skin_of(const Atlas& free, const MaterialRatios& m, const ElasticCorrection& elastic)
{
  return free.shape(m).as_skin_of(elastic, Atlas::depth);
}

}  // namespace

std::vector<RunJob> midplane_jobs(const MidplaneGrid& grid, const RunSource& source)
{
  std::vector<RunJob> jobs;
  for (const double nu : grid.poisson_ratios()) jobs.push_back(elastic_job(nu, source));
  for (const MaterialRatios& m : grid.materials())
    add_jobs(jobs, m, plan_for(m), source, "midplane, ");
  return jobs;
}

MidplaneShapes midplane_from(const Atlas& free, const MidplaneGrid& grid,
                             const std::vector<RunOutcome>& outcomes)
{
  std::size_t next = 0;
  const std::vector<double> ratios = grid.poisson_ratios();
  std::vector<ElasticCorrection> elastic;
  for (std::size_t k = 0; k < ratios.size(); ++k)
    elastic.push_back(fit_elastic(contact_record_of(outcomes[next++].result)));
  std::vector<MidplaneShapes::Node> nodes;
  for (const MaterialRatios& m : grid.materials()) {
    const ContactRecords records = records_of(m, plan_for(m), outcomes, next);
    const auto ratio = std::find(ratios.begin(), ratios.end(), m.poisson_ratio) - ratios.begin();
    const ElasticCorrection& correction = elastic[static_cast<std::size_t>(ratio)];
    const double onset = sphere_of(m).onset;
    const LawShape guide = skin_of(free, m, correction);
    LawShape change = fit_shape(records, correction, onset, Atlas::depth, &guide).shape;
    change.add(-1, guide);
    nodes.push_back({m, std::move(change)});
  }
  return {grid, std::move(elastic), std::move(nodes)};
}

namespace {

/// Deviation of the atlas's curve from a press.
MidplaneCheck compare(MidplaneCheck check, const Atlas& atlas, const RunResult& run)
{
  const ContactLaw law(atlas.midplane_shape(check.material), MidplaneShapes::depth);
  const ContactRecord record = contact_record_of(run);
  double sum = 0;
  int count = 0;
  for (const auto& [x, force, radius] : record.loading)
    if (x > record.depth / 3) {
      sum += std::pow(law.force(x) / force - 1, 2);
      ++count;
    }
  check.error_force = std::sqrt(sum / count);
  const double x = record.depth;
  check.error_restitution =
      std::sqrt(law.kept(x)) - std::sqrt(record.work_ratio);
  check.error_recovery = (x - law.reversal(x).residual()) / (x - record.residual) - 1;
  return check;
}

}  // namespace

std::vector<MidplaneCheck> check_midplane(const Atlas& atlas, Farm& farm, int count, unsigned seed,
                                          const Progress& progress)
{
  std::mt19937 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  const auto between = [&](double low, double high) { return low * std::pow(high / low, uniform()); };
  const RunSource source;
  std::vector<MidplaneCheck> checks;
  std::vector<RunJob> jobs;
  for (int k = 0; k < count; ++k) {
    MidplaneCheck c;
    c.material.stiffness = between(atlas.grid().stiffnesses.front(), atlas.grid().stiffnesses.back());
    c.material.poisson_ratio = atlas.grid().block_poisson_ratios.back() * uniform();
    c.material.hardening = uniform() < 0.25 ? 0.0 : between(1e-3, atlas.grid().hardenings.back());
    const CharacterisedBody body = sphere_of(c.material);
    c.depth = between(std::max(0.01, 3 * body.onset), 0.3);
    checks.push_back(c);
    SamplingPlan::Press press{c.depth, {}, 24, 2};
    press.support = Support::midplane;
    jobs.push_back(press_job(body, press, source));
  }
  const std::vector<RunResult> results = farm.run_all(jobs, progress);
  for (std::size_t k = 0; k < checks.size(); ++k) checks[k] = compare(checks[k], atlas, results[k]);
  return checks;
}

}  // namespace granulaw
