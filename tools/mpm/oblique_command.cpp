// mpm oblique: an oblique impact with friction on a rigid wall, by a particle code's tangential laws or the solver.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <memory>

#include "base/error.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "law/oblique.hpp"
#include "material_file/materials_file.hpp"
#include "option_checks.hpp"
#include "solver/runs.hpp"
#include "sphere_law.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_oblique {

struct ObliqueRequest
{
  std::string materials, particle, law, tangential = "plastic";
  double velocity = 0, angle = 0, friction = 0;  // m/s, degrees, -
  int steps = 2000, resolution = 10, jobs = 1;
  bool json = false;
};

/// One way to compute the impact.
struct Row
{
  std::string way;
  double e, e_tangential, spin, cpu_s;  // spin: rad/s
};

Row by_law(const ObliqueRequest& r, const PairLaw& pair, const ObliqueThrow& thrown, TangentialKind kind)
{
  constexpr double customary_damping = 0.1;  // tangentialDampingRatio of the plug-in
  const std::clock_t start = std::clock();
  const ObliqueAnswer a = replay_oblique(pair, thrown, kind, r.friction, customary_damping, r.steps);
  return {kind == TangentialKind::plastic ? "plastic" : "history", a.restitution, a.tangential / thrown.tangential_velocity, a.spin,
      static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
}

Row by_solver(const ObliqueRequest& r, const Particle& particle, const ObliqueThrow& thrown)
{
  Approach approach;
  approach.velocity = thrown.velocity, approach.tangential_velocity = thrown.tangential_velocity;
  approach.friction = r.friction;
  RunOptions options;
  options.grid = GridKind::spatial, options.resolution = r.resolution, options.shifted_grids = 1;
  options.threads = r.jobs;
  ProgressBar bar;
  options.progress = [&](double done) { bar.update(done, ""); };
  const RunResult run = granulaw::impact(particle, approach, {}, options);
  const Rebound& rebound = run.rebound.value();
  return {"solver", rebound.normal, rebound.tangential, rebound.spin[1], run.summary.cpu_s};
}

void print(const std::vector<Row>& rows)
{
  fmt::print("{:<10} {:>8} {:>13} {:>16} {:>9}\n", "tangential", "e", "e_tangential", "spin, rad/s", "CPU s");
  for (const Row& row : rows) fmt::print("{:<10} {:>8.4f} {:>13.4f} {:>16.5g} {:>9.2g}\n", row.way, row.e, row.e_tangential, row.spin, row.cpu_s);
}

void oblique(const ObliqueRequest& r)
{
  const MaterialsFile file = read_materials(r.materials);
  const Particle& particle = file.particle(r.particle);
  if (!particle.is_homogeneous_sphere()) fail(r.materials, fmt::format("'{}' is no homogeneous sphere", r.particle), r.particle, "a sphere of one material");
  const Material& material = particle.materials.front();
  const double along = r.velocity * std::tan(r.angle * M_PI / 180.0);
  const ObliqueThrow thrown{particle.radius, particle.volume() * material.density, r.velocity, along};
  std::vector<Row> rows;
  if (r.tangential == "solver")
    rows.push_back(by_solver(r, particle, thrown));
  else {
    const SphereLaw of = sphere_law(r.materials, r.particle, r.law, "oblique", "--tangential solver");
    const PairLaw pair = of.wall();
    if (const std::string why = unknown_flow_stress(of.law, pair); r.tangential == "plastic" && !why.empty()) fail(of.source, why);
    rows.push_back(by_law(r, pair, thrown, r.tangential == "history" ? TangentialKind::history : TangentialKind::plastic));
    if (!r.json && r.tangential == "plastic") rows.push_back(by_law(r, pair, thrown, TangentialKind::history));
  }
  if (!r.json) return print(rows);
  const Row& row = rows.front();
  print_json({{"tangential", row.way}, {"e", json_number(row.e)}, {"e_tangential", json_number(row.e_tangential)}, {"spin_after_rad_s", json_number(row.spin)},
      {"velocity_normal_m_per_s", r.velocity}, {"velocity_tangential_m_per_s", along}, {"friction", r.friction}, {"cpu_s", row.cpu_s}});
}

void define(Options& command)
{
  const auto r = std::make_shared<ObliqueRequest>();
  command.add_option("materials", r->materials, "MATERIALS.toml").required();
  command.add_option("--particle", r->particle, "name of a sphere in it").required();
  command.add_option("--velocity", r->velocity, "normal approach speed, m/s").required().check(above_zero());
  command.add_option("--angle", r->angle, "of the velocity from the wall's normal, degrees").required().check(from_to(0.1, 89.0));
  command.add_option("--friction", r->friction, "Coulomb's coefficient").required().check(from_to(0.0, 10.0));
  command
      .add_option("--tangential", r->tangential,
          "'plastic' and 'history': LIGGGHTS's integration of the contact under the law; 'solver': the material point method in three dimensions, seconds to minutes")
      .among({"history", "plastic", "solver"})
      .capture_default_str();
  command.add_option("--law", r->law, "law file; without it the atlas's law of the material");
  command.add_option("--steps", r->steps, "time steps in Hertz's contact time").check(whole_from_to(10, 1000000)).capture_default_str();
  command.add_option("--resolution", r->resolution, "solver: cells across the contact").check(whole_from_to(6, 60)).capture_default_str();
  command.add_option("--jobs", r->jobs, "solver: threads").check(whole_from_to(1, 1024)).capture_default_str();
  command.add_flag("--json", r->json, "one JSON object");
  command.callback([r] { oblique(*r); });
}

}  // namespace of_oblique

extern const Command oblique_command{"oblique",
    "A sphere without spin hits a rigid wall obliquely: e, tangential velocity and spin after.\n"
    "By LIGGGHTS's tangential history, by tangential plastic, or by the solver.\n"
    "Example: mpm oblique materials.toml --particle grain --velocity 1.0 --angle 45 --friction 0.3",
    of_oblique::define};

}  // namespace granulaw
