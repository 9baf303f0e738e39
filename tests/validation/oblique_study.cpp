// Plastic oblique impacts with friction under `tangential history` and `tangential plastic`, against the solver in three
// dimensions: a sphere of one material without spin hits a rigid wall at one normal velocity, at several
// angles from the wall's normal and with several coefficients of friction.
//
//   oblique_study FOLDER OUTPUT.json --atlas ATLAS.h5 [--cells N] [--grids N] [--stiffness E*/Y]
//                 [--hardening H/E] [--velocity V/V_y] [--angles A,A,...] [--frictions MU,MU,...]
//                 [--steps N] [--threads N]
//   runs are kept in FOLDER and not made again; oblique_page.py draws OUTPUT.json
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/body/characterised_body.hpp"
#include "atlas/law_from_atlas.hpp"
#include "characterise/body/law_material.hpp"
#include "farm/farm.hpp"
#include "law/oblique.hpp"
#include "solver/runs.hpp"
#include "solver/solver_id.hpp"

namespace {

using namespace granulaw;
using Json = nlohmann::ordered_json;

constexpr double radius = 1e-3;         // m
constexpr double damping_ratio = 0.1;  // the plug-in's default

struct Setting
{
  int cells = 10, grids = 4, steps = 20000;
  double stiffness = 100, hardening = 0, velocity = 100;       // E*/Y, H/E, V/V_y
  std::vector<double> angles{10, 20, 30, 40, 50, 60, 70, 80};  // degrees from the wall's normal
  std::vector<double> frictions{0.1, 0.3, 0.6};
};

Material material_of(const Setting& s)
{
  Material m;
  m.density = 1500, m.youngs_modulus = 9.1e9, m.poisson_ratio = 0.3;
  m.yield_stress = m.e_star() / s.stiffness;
  m.hardening_modulus = s.hardening * m.youngs_modulus;
  return m;
}

/// Thornton's customary yield velocity, m/s.
double yield_velocity(const Material& m)
{
  const double ratio = M_PI / (2 * m.e_star());
  return ratio * ratio * std::sqrt(2 / (5 * m.density)) * std::pow(1.6 * m.yield_stress, 2.5);
}

struct Case
{
  double friction, angle;  // angle: degrees from the normal
};

std::vector<Case> cases(const Setting& s)
{
  std::vector<Case> all;
  for (const double friction : s.frictions)
    for (const double angle : s.angles) all.push_back({friction, angle});
  return all;
}

RunJob job_of(const Particle& particle, const Case& c, double velocity, const Setting& s)
{
  Approach thrown;
  thrown.velocity = velocity, thrown.friction = c.friction;
  thrown.tangential_velocity = velocity * std::tan(c.angle * M_PI / 180);
  RunJob job;
  job.label = fmt::format("mu {:g}, {:g} degrees", c.friction, c.angle);
  job.key = fmt::format("oblique {} v={:.17g} vt={:.17g} mu={:g} cells={} grids={} solver={}",
                        description_of(particle.materials[0]), velocity, thrown.tangential_velocity,
                        c.friction, s.cells, s.grids, solver_id());
  job.run = [particle, thrown, s](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = s.cells, options.shifted_grids = s.grids, options.grid = GridKind::spatial;
    return impact(particle, thrown, {}, options);
  };
  return job;
}

/// In units of the throw: velocities over V, impulses over m V.
Json row(double e, double along, double spin, double normal, double tangential)
{
  return {{"e", e}, {"tangential", along}, {"spin", spin}, {"impulse", normal}, {"impulse_t", tangential}};
}

Json as_row(const ObliqueAnswer& a, const ObliqueThrow& t)
{
  const double v = t.velocity, j = t.mass * v;
  return row(a.restitution, a.tangential / v, a.spin * t.radius / v, a.impulse_normal / j,
             a.impulse_tangential / j);
}

/// Time in s; forces over Y R^2, lengths over R, torque about the centre of mass over Y R^3.
Json trace_of(const RunResult& run, double yield)
{
  Json trace;
  const double unit = yield * radius * radius;
  for (std::size_t k = 0; k < run.planes.front().samples.size(); ++k) {
    const PlaneSample& p = run.planes.front().samples[k];
    trace.push_back({run.trace[k].time, run.trace[k].delta / radius, p.force / unit, p.vector[0] / unit,
                     std::sqrt(p.axes[0] * p.axes[1]) / radius, p.centre[0] / radius,
                     p.torque[1] / (unit * radius)});
  }
  return trace;
}

Json study(const Setting& s, const BodyLaw& law, Farm& farm)
{
  Particle particle;
  particle.materials = {material_of(s)};
  particle.radius = radius;
  const Material& m = particle.materials[0];
  const double v = s.velocity * yield_velocity(m), mass = particle.volume() * m.density;
  const std::vector<Case> all = cases(s);
  std::vector<RunJob> jobs;
  for (const Case& c : all) jobs.push_back(job_of(particle, c, v, s));
  jobs.push_back(job_of(particle, {0, 45}, v, s));  // without friction
  const std::vector<RunOutcome> runs = farm.run(jobs);

  Json out;
  out["e_frictionless"] = runs.back().result.rebound.value().normal;
  out["frictionless"] = trace_of(runs.back().result, m.yield_stress);
  out["stiffness"] = s.stiffness, out["hardening"] = s.hardening, out["velocity"] = s.velocity,
  out["cells"] = s.cells, out["grids"] = s.grids;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (runs[k].failed()) {
      fmt::print("{}: left out: {}\n", jobs[k].label, runs[k].error);
      continue;
    }
    const Rebound& r = *runs[k].result.rebound;
    const ObliqueThrow thrown{radius, mass, v, v * std::tan(all[k].angle * M_PI / 180)};
    Json one{{"friction", all[k].friction}, {"angle", all[k].angle}};
    one["solver"] = row(r.normal, r.tangential * thrown.tangential_velocity / v, r.spin[1] * radius / v,
                        r.impulse_normal / (mass * v), r.impulse_tangential / (mass * v));
    const PairLaw wall = wall_pair(law);
    for (const auto& [name, kind] : {std::pair{"history", TangentialKind::history}, {"plastic", TangentialKind::plastic}})
      one[name] = as_row(replay_oblique(wall, thrown, kind, all[k].friction, damping_ratio, s.steps), thrown);
    one["trace"] = trace_of(runs[k].result, m.yield_stress);
    out["cases"].push_back(one);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Oblique impacts: a particle code's contact against the solver");
  std::string folder, output, atlas_file;
  Setting setting;
  int threads = 1;
  app.add_option("folder", folder)->required();
  app.add_option("output", output)->required();
  app.add_option("--atlas", atlas_file)->required();
  app.add_option("--cells", setting.cells)->check(CLI::Range(6, 60));
  app.add_option("--grids", setting.grids)->check(CLI::Range(1, 64));
  app.add_option("--stiffness", setting.stiffness)->check(CLI::Range(20.0, 5000.0));
  app.add_option("--hardening", setting.hardening)->check(CLI::Range(0.0, 1.0));
  app.add_option("--angles", setting.angles)->delimiter(',')->check(CLI::Range(0.0, 89.0));
  app.add_option("--frictions", setting.frictions)->delimiter(',')->check(CLI::Range(0.0, 2.0));
  app.add_option("--velocity", setting.velocity)->check(CLI::Range(2.0, 1000.0));
  app.add_option("--steps", setting.steps)->check(CLI::Range(10, 1000000));
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  try {
    const Atlas atlas = read_atlas(atlas_file);
    LawRange options;
    options.depth = 0.3, options.fastest = 0.3;
    const BodyLaw law = law_from(atlas, law_material("material", material_of(setting)), options);
    ThreadFarm farm(threads, RunCache(folder));
    std::ofstream(output) << study(setting, law, farm).dump(1) << "\n";
    fmt::print("{} runs, {:.0f} CPU s\n", farm.count().made, farm.count().cpu_s);
  } catch (const Error& error) {
    fmt::print(stderr, "oblique_study: {}\n", error.what());
    return 2;
  }
}
