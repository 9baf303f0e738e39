// How right are the atlas and its laws where nobody sampled them (docs/evidence/atlas.md)? Runs are kept in FOLDER and not made again.
//
//   atlas_study FOLDER --atlas ATLAS.h5 [--threads N] impacts [--count N] [--seed N]
//       random materials and speeds of its range (check_atlas() in atlas_build.hpp draws them), each against a fresh impact, run
//       as `mpm impact` would; a larger --count begins with the same materials. Seed 1 drew the atlas's own checks. Exit 0: the
//       certificate is true of F_max and e in at least 95 % of the impacts, and no error exceeds twice what it claims.
//   atlas_study FOLDER --atlas ATLAS.h5 [--threads N] laws [--impacts N] [--cells N] [--press-cells N] [--press-grids N]
//               [--materials N] [--seed N] [--each]
//       laws of four materials against impacts at random velocities (e, F_max, contact time; four shifted grids), and against
//       slow presses with three partial unloadings at random overlaps: the largest |F_law - F|/F_max on loading and on un- and
//       reloading, and the area of the reload loops, which the law leaves out, over the work. The force of a press is as
//       computed, with the grid noise of the contact edge: more cells and grids leave less of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "atlas/law_from_atlas.hpp"
#include "base/error.hpp"
#include "base/larger.hpp"
#include "base/scales.hpp"
#include "atlas_build.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"
#include "law/replay.hpp"

namespace {

using namespace granulaw;

/// Magnitudes of one kind of error against what is claimed and what is wanted of it.
struct Errors
{
  const char* name;
  double claimed, wanted;
  std::vector<double> all{};

  void add(double signed_error) { all.push_back(std::abs(signed_error)); }
  double share_within(double bound) const
  {
    const auto within = std::count_if(all.begin(), all.end(), [&](double x) { return x <= bound; });
    return static_cast<double>(within) / static_cast<double>(all.size());
  }
  double worst() const { return *std::max_element(all.begin(), all.end()); }
  bool certificate_holds() const { return share_within(claimed) >= 0.95 && worst() <= 2 * claimed; }

  void print() const
  {
    std::vector<double> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    fmt::print(
        "{:5s} median {:.4f}, 95 % {:.4f}, worst {:.4f}; within {:g}: {:.1f} %; certificate {:.4f}: true in "
        "{:.1f} %, worst {:.2f} of it\n",
        name, sorted[sorted.size() / 2], sorted[(sorted.size() - 1) * 95 / 100], worst(), wanted,
        100 * share_within(wanted), claimed, 100 * share_within(claimed), worst() / claimed);
  }
};

/// Dimensionless: R = E* = rho = 1.
LawMaterial dimensionless(const MaterialRatios& m)
{
  LawMaterial law;
  law.name = "material", law.density = 1, law.poisson_ratio = m.poisson_ratio;
  law.youngs_modulus = 1 - m.poisson_ratio * m.poisson_ratio;
  law.yield_stress = 1 / m.stiffness;
  law.hardening_modulus = m.hardening * law.youngs_modulus;
  return law;
}

/// The same impacts by laws of three tolerances, each beside what it states of itself at that speed: a law that leaves its velocity axis out says what that
/// costs. A good bound is true in 95 %, and error over bound reaches 1 there.
void study_statements(const Atlas& atlas, const std::vector<AtlasCheck>& checks)
{
  constexpr double mass = 4. / 3 * M_PI;
  const auto said = [&](const AtlasCheck& c, const BodyLaw& law) { return replay_on_wall(law, 1, mass, c.speed / std::sqrt(c.material.stiffness)); };
  for (const double tolerance : {0.001, 0.01, 0.1}) {
    Errors force{"F", 1, 1}, restitution{"e", 1, 1};
    int without_axis = 0;
    for (const AtlasCheck& c : checks) {
      LawRange usual, range;
      usual.depth = range.depth = Atlas::depth, range.tolerance = tolerance;
      const LawMaterial material = dimensionless(c.material);
      const BodyLaw law = law_from(atlas, material, range);
      const Replay checked = said(c, law_from(atlas, material, usual)), now = said(c, law);
      const double run_force = checked.force_max / (1 + c.error_force), run_e = checked.restitution - c.error_restitution;
      const ErrorBound bound = bound_of(law).at(wall_pair(law).axis_speed(1, mass, c.speed / std::sqrt(c.material.stiffness)));
      force.add((now.force_max / run_force - 1) / bound.force);
      restitution.add((now.restitution - run_e) / bound.restitution_at(run_e));
      without_axis += !bound_of(law).omitted_axis.empty();
    }
    fmt::print("tolerance {:g}, {} laws without their axis; error over the bound stated at that speed:\n", tolerance, without_axis);
    force.print(), restitution.print();
  }
}

bool study_impacts(const Atlas& atlas, Farm& farm, int count, unsigned seed)
{
  Errors force{"F_max", atlas.claimed_force(), 0.01}, restitution{"e", atlas.claimed_restitution(), 0.005};
  fmt::print("    E*/Y     nu     H/E  sqrt(I)      F_max        e  solver's own estimate\n");
  const std::vector<AtlasCheck> checks = check_atlas(atlas, farm, count, seed, {});
  for (const AtlasCheck& c : checks) {
    force.add(c.error_force), restitution.add(c.error_restitution);
    const bool beyond = force.all.back() > force.wanted || restitution.all.back() > restitution.wanted;
    fmt::print("{:8.1f}  {:.3f}  {:.4f}  {:.5f}  {:+7.2f} %  {:+.4f}  {:.2f} %{}\n", c.material.stiffness,
               c.material.poisson_ratio, c.material.hardening, c.speed, 100 * c.error_force,
               c.error_restitution, 100 * c.solver_estimate, beyond ? "  <" : "");
  }
  fmt::print("{} impacts, seed {}\n", count, seed);
  force.print();
  restitution.print();
  study_statements(atlas, checks);
  return force.certificate_holds() && restitution.certificate_holds();
}

/// Largest and 95th-percentile magnitude of signed errors.
std::string worst(std::vector<double> errors)
{
  for (double& error : errors) error = std::abs(error);
  std::sort(errors.begin(), errors.end());
  return fmt::format("{:.4f} (95 %: {:.4f})", errors.back(), errors[errors.size() * 95 / 100]);
}

/// Largest deviations of the law from the run's force along its path, over the run's largest force: on virgin
/// loading, where the run has the grid noise of the contact edge, and on unloading and reloading, where the
/// law has one curve.
struct PathErrors
{
  double loading = 0, unloading = 0;
};
PathErrors path_errors(const PairLaw& law, const RunResult& run)
{
  double deepest = 0, largest = 0;
  PathErrors errors;
  for (const TraceSample& s : run.trace) {
    deepest = larger(deepest, s.delta);
    largest = larger(largest, s.force);
    double& error = s.branch == Branch::load ? errors.loading : errors.unloading;
    error = larger(error, std::abs(law.evaluate(1, s.delta, deepest).force - s.force));
  }
  return {errors.loading / largest, errors.unloading / largest};
}

/// References that the law is compared with.
struct References
{
  int impacts = 50, cells = 24, press_cells = 24, press_grids = 4;
  bool each = false;
};

void study_law(const Atlas& atlas, const MaterialRatios& m, const References& references, std::mt19937& random, Farm& farm)
{
  const LawMaterial material = dimensionless(m);
  const CharacterisedBody body = characterised_body_of(m.stiffness, m.poisson_ratio, m.hardening);
  LawRange options;
  options.depth = 0.2, options.fastest = 0.25;
  const BodyLaw law = law_from(atlas, material, options);
  const PairLaw pair = wall_pair(law);

  const int impacts = references.impacts;
  const RunSource source;
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<RunJob> jobs;
  std::vector<double> velocities;
  // sqrt(I) from 1.5 onsets, or what reaches 3e-5 R (shallower impacts take many minutes), to 0.245, evenly
  // in its logarithm
  const double slowest =
      std::max(1.5 * onset_velocity(1, 1 / m.stiffness, 1, m.poisson_ratio), velocity_to(3e-5, body));
  const double fastest = 0.245 / std::sqrt(m.stiffness);
  for (int k = 0; k < impacts; ++k) {
    velocities.push_back(slowest * std::pow(fastest / slowest, share(random)));
    jobs.push_back(impact_job(body, velocities.back(), references.cells, 4, source));
  }
  for (const double depth : {0.02, 0.15}) {
    SamplingPlan::Press press{depth, {}, references.press_cells, references.press_grids};
    for (int k = 0; k < 3; ++k) press.stops.push_back(depth * (0.1 + 0.3 * (k + share(random))));
    jobs.push_back(press_job(body, press, source));
  }
  const std::vector<RunResult> runs = farm.run_all(jobs);

  std::vector<double> e, force, time;
  for (int k = 0; k < impacts; ++k) {
    const RunSummary& run = runs[static_cast<std::size_t>(k)].summary;
    const Replay replay = replay_collision(pair, 1, 4. / 3 * M_PI, velocities[static_cast<std::size_t>(k)]);
    if (replay.left_range) continue;  // deeper than the law: it says so
    e.push_back(replay.restitution - run.restitution);
    force.push_back(replay.force_max / run.force_max - 1);
    time.push_back(replay.contact_time / run.contact_time - 1);
    if (references.each)
      fmt::print("  sqrt(I) {:.5f}  delta/R {:.5f}  e {:.4f} {:+.4f}  F {:+.2f} %  time {:+.2f} %\n",
                 velocities[static_cast<std::size_t>(k)] * std::sqrt(m.stiffness), run.delta_max,
                 run.restitution, e.back(), 100 * force.back(), 100 * time.back());
  }
  fmt::print("E*/Y {:g}, nu {:g}, H/E {:g}: {} impacts: e {}, F {}, time {}\n", m.stiffness, m.poisson_ratio,
             m.hardening, e.size(), worst(e), worst(force), worst(time));
  for (std::size_t k = static_cast<std::size_t>(impacts); k < runs.size(); ++k) {
    double loop = 0;
    partial_unloadings(runs[k], loop);
    const PathErrors error = path_errors(pair, runs[k]);
    fmt::print(
        "  press to {:.2f} R with three reloadings: |F_law - F|/F_max on loading {:.4f}, on un- and "
        "reloading "
        "{:.4f}; loop {:.4f} of the work\n",
        runs[k].summary.delta_max, error.loading, error.unloading, loop);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("The atlas and its laws against fresh runs");
  std::string folder, atlas_file;
  References references;
  int count = 200, materials = 4, threads = 1;
  unsigned seed = 2, law_seed = 1;
  app.add_option("folder", folder)->required();
  app.add_option("--atlas", atlas_file)->required();
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  app.require_subcommand(1);
  CLI::App *impacts = app.add_subcommand("impacts"), *laws = app.add_subcommand("laws");
  impacts->add_option("--count", count)->check(CLI::Range(1, 100000));
  impacts->add_option("--seed", seed);
  laws->add_option("--impacts", references.impacts)->check(CLI::Range(1, 1000));
  laws->add_option("--cells", references.cells, "of the impacts")->check(CLI::Range(12, 96));
  laws->add_option("--press-cells", references.press_cells)->check(CLI::Range(12, 96));
  laws->add_option("--press-grids", references.press_grids)->check(CLI::Range(1, 64));
  laws->add_option("--materials", materials, "only the first N")->check(CLI::Range(1, 4));
  laws->add_option("--seed", law_seed);
  laws->add_flag("--each", references.each, "a line for each impact, too");
  CLI11_PARSE(app, argc, argv);
  try {
    const Atlas atlas = read_atlas(atlas_file);
    ThreadFarm farm(threads, RunCache(folder));
    if (*impacts) return study_impacts(atlas, farm, count, seed) ? 0 : 1;
    std::mt19937 random(law_seed);
    const std::vector<MaterialRatios> all{{100, 0.3, 0}, {30, 0.3, 0}, {500, 0.25, 0.01}, {1500, 0.35, 0}};
    for (int k = 0; k < materials; ++k) study_law(atlas, all[static_cast<std::size_t>(k)], references, random, farm);
  } catch (const Error& error) {
    fmt::print(stderr, "atlas_study: {}\n", error.what());
    return 2;
  }
}
