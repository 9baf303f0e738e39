// Laws by runs of bodies that the atlas does not hold, against fresh impacts: the CPU time of the runs that each law
// took, and the errors of F_max and e at speeds between the onset of yield and the law's fastest impact.
//
//   granulaw_body_study FOLDER --atlas ATLAS.h5 [--bodies ellipsoid,skin,...] [--impacts N] [--threads N]
//   runs are kept in FOLDER and not made again: they count with the CPU time that they took
//
// One line a body, and one for each impact. Impacts: 24 cells, four shifted grids, as the law's own.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/build/build_law.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"
#include "law/replay.hpp"

namespace {

using namespace granulaw;

constexpr double radius = 1e-3;     // m
constexpr double e_star = 100e9;    // Pa

Material of_stiffness(double e_star_over_yield, double hardening_over_e = 0)
{
  Material m;
  m.density = 7800, m.poisson_ratio = 0.3;
  m.youngs_modulus = e_star * (1 - 0.09);
  m.yield_stress = e_star / e_star_over_yield;
  m.hardening_modulus = hardening_over_e * m.youngs_modulus;
  return m;
}

Particle ellipsoid(double aspect, const Material& m)
{
  constexpr int segments = 2000;
  std::vector<ProfilePoint> points;
  for (int k = 0; k <= segments; ++k) {
    const double angle = M_PI * k / segments, half = std::sin(0.5 * angle);
    points.push_back({radius * std::sin(angle), 2 * aspect * radius * half * half});
  }
  points.front() = {0, 0}, points.back().r = 0;
  Particle p = Particle::sphere(radius, m);
  p.profile = Profile(points);
  return p;
}

/// A skin of .1 R (E*/Y 200, H/E .01) on a core `stiffer` times as stiff with `stronger` times its yield stress.
Particle skin(double thickness, double stiffer, double stronger)
{
  const Material outer = of_stiffness(200, 0.01);
  Material core = outer;
  core.youngs_modulus *= stiffer, core.yield_stress *= stronger;
  Particle p = Particle::sphere(radius, core);
  p.materials.push_back(outer);
  p.layers.push_back({thickness * radius, 1});
  return p;
}

struct Body
{
  const char* name;
  Particle particle;
};

std::vector<Body> bodies()
{
  std::vector<Body> all;
  all.push_back({"ellipsoid", ellipsoid(1.5, of_stiffness(200))});
  all.push_back({"skin", skin(0.1, 0.5, 2)});
  all.push_back({"stiff-core", skin(0.1, 2, 3)});
  Particle pore = Particle::sphere(radius, of_stiffness(100, 0.01));
  pore.inclusions.push_back({0, 0.6 * radius, 0.3 * radius, -1});
  all.push_back({"pore", pore});
  Material cs = of_stiffness(300);
  cs.rate = {"cowper-symonds", {{"reference_rate", {1e4}}, {"exponent", {5}}}};
  all.push_back({"cowper-symonds", Particle::sphere(radius, cs)});
  Material jc = of_stiffness(500);
  jc.hardening = {"johnson-cook", {{"strength", {1.3 * jc.yield_stress}}, {"exponent", {0.3}}}};
  all.push_back({"johnson-cook", Particle::sphere(radius, jc)});
  Material voce = of_stiffness(300);
  voce.hardening = {"voce", {{"saturation_stress", {1.8 * voce.yield_stress}}, {"strain", {0.1}}}};
  all.push_back({"voce", Particle::sphere(radius, voce)});
  return all;
}

void study(const Body& of, const Atlas& atlas, Farm& farm, Farm& checks, int impacts)
{
  const CharacterisedBody body = characterised_body_of(of.particle);
  BuildOptions options;
  options.depth = 0.1, options.fastest = 0.1, options.atlas = &atlas, options.farm = &farm;
  const FarmCount before = farm.count();
  const BuiltLaw built = build_law(of.name, of.particle, options);
  const FarmCount& after = farm.count();
  const double cpu = after.cpu_s + after.cpu_s_saved - before.cpu_s - before.cpu_s_saved;
  const long runs = after.made + after.from_cache - before.made - before.from_cache;

  const double slowest = velocity_to(1e-3, body), fastest = 0.95 * options.fastest * std::sqrt(body.yield);
  const RunSource source;
  std::vector<double> velocities{velocity_to(std::max(2e-4, 1.25 * body.onset), body)};
  std::vector<RunJob> jobs{impact_job(body, velocities.front(), 24, 2, source)};
  for (int k = 0; k < impacts; ++k) {
    velocities.push_back(slowest * std::pow(fastest / slowest, static_cast<double>(k) / (impacts - 1)));
    jobs.push_back(impact_job(body, velocities.back(), 24, 4, source));
  }
  const std::vector<RunResult> results = checks.run_all(jobs);
  const Scales unit{body.scale.length, built.law.material.e_star(), built.law.material.density};
  double force = 0, e = 0;
  std::string lines;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const RunSummary& run = results[k].summary;
    const Replay law =
        replay_on_wall(built.law, unit.length, body.mass * unit.mass(), velocities[k] * unit.velocity());
    if (law.held_speed) continue;  // below the axis of a rate the law states no error
    const double df = law.force_max / unit.force() / run.force_max - 1, de = law.restitution - run.restitution;
    force = larger(force, std::abs(df)), e = larger(e, std::abs(de));
    lines += fmt::format("    x {:.5f}  e {:.4f} {:+.4f}  F {:+.2f} %\n", run.delta_max, run.restitution, de, 100 * df);
  }
  const Certificate& c = built.law.certificate;
  fmt::print("{:15} {:3} runs, CPU {:.1f} s; F {:.2f} %, e {:.4f}; stated: sampling {:.4f}, verification F {:.4f} e {:.4f} "
             "of {}; cells F {:.4f} e {:.4f}; [{}]\n{}",
             of.name, runs, cpu, 100 * force, e, built.sampling_error, c.verification_error_force,
             c.verification_error_restitution, c.verification_impacts, c.solver_error_force, c.solver_error_restitution,
             built.guide, lines);
  for (const std::string& hole : built.holes) fmt::print("    hole: {}\n", hole);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Laws by runs of bodies that the atlas does not hold");
  std::string folder, atlas_file;
  std::vector<std::string> names;
  int impacts = 5, threads = 1;
  app.add_option("folder", folder)->required();
  app.add_option("--atlas", atlas_file)->required();
  app.add_option("--bodies", names)->delimiter(',');
  app.add_option("--impacts", impacts)->check(CLI::Range(2, 100));
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  try {
    const Atlas atlas = read_atlas(atlas_file);
    ThreadFarm farm(threads, RunCache(folder)), checks(threads, RunCache(folder));
    for (const Body& body : bodies())
      if (names.empty() || std::find(names.begin(), names.end(), body.name) != names.end()) try {
          study(body, atlas, farm, checks, impacts);
        } catch (const Error& error) {
          fmt::print("{}: {}\n", body.name, error.what());
          std::fflush(stdout);
        }
  } catch (const Error& error) {
    fmt::print(stderr, "body_study: {}\n", error.what());
    return 2;
  }
}
