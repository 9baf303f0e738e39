// mpm press: one slow press and unloading by the solver, onto a wall or another particle.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "collision_report.hpp"
#include "command.hpp"
#include "material_file/planes_file.hpp"
#include "option_checks.hpp"
#include "press_by_law.hpp"
#include "run_report.hpp"
#include "solver/runs.hpp"
#include "sphere_law.hpp"

namespace granulaw {

namespace of_press {

struct PressRequest
{
  RunRequest run;
  double depth = 0;  // over R
  std::string support = "free";
  std::optional<double> ramp;  // R/c*
  std::string planes, by = "solver", law;
};

/// Shallowest press, over R: a contact of about 1e-4 R. The time step goes with its cells, so smaller ones
/// take days.
constexpr double shallowest = 1e-8;

void check(const PressRequest& r)
{
  r.run.check();
  if (r.support != "free" && r.support != "midplane") fail("--support", "unknown support", r.support, "free, midplane");
}

void check_numbers(const PressRequest& r)
{
  require(r.depth >= shallowest && r.depth <= 0.8, "--depth", fmt::format("{:g} (a fraction of the radius)", r.depth), fmt::format("{:g} to 0.8", shallowest));
  if (r.ramp) require(*r.ramp >= 1 && *r.ramp <= 1e6, "--ramp", fmt::format("{:g} R/c*", *r.ramp), "1 to 1e6");
}

/// A press by the law has no grid.
void check_by_law(const PressRequest& r)
{
  const RunRequest& run = r.run;
  const char* option = !run.fields.empty() ? "--fields" : !run.checkpoint.empty() ? "--checkpoint" : run.tolerance ? "--tolerance" : run.resolution ? "--resolution" : "";
  if (*option) fail("--by", fmt::format("law has no grid: leave out {}", option), r.by, "solver");
  if (r.support != "free") fail("--support", "cannot go with --by law: planes hold the body", r.support, "no --support");
}

PressPlan plan_of(const PressRequest& r, const Particle& particle)
{
  PressPlan plan;
  plan.ramp = r.ramp.value_or(0);
  plan.depth = r.depth * particle.radius;
  plan.support = r.support == "free" ? Support::free : Support::midplane;
  return plan;
}

PressPlan plan_by_planes(const PressRequest& r, const Particle& particle)
{
  PressPlan plan;
  plan.planes = read_planes(r.planes.empty() ? "pair" : r.planes, "--planes");
  plan.depth = r.depth * particle.radius;
  plan.ramp = r.ramp.value_or(0);
  return plan;
}

void press_by_planes(const PressRequest& r, const Meeting& m, RunIdentity asked, const std::function<void(const RunIdentity&, const Run&)>& run)
{
  if (r.support != "free") fail("--support", "cannot go with three dimensions: planes hold the body", r.support);
  const PressPlan plan = plan_by_planes(r, m.particle);
  for (const PressPlane& p : plan.planes)
    asked.emplace_back("--planes", fmt::format("{} {} {} {}", fmt::join(p.direction, " "), p.distance.value_or(-1), p.speed, p.friction));
  run(asked, [&](const RunOptions& options) { return granulaw::press(m.particle, plan, m.partner, options); });
}

void press_by_law(PressRequest& r, const Meeting& m)
{
  check_by_law(r);
  const SphereLaw law = sphere_law(r.run.materials, r.run.particle, r.law, "press", "--by solver");
  const PairLaw wall = law.wall();
  const double error = wall.yielding->bound.confined_force;
  if (!r.run.json)
    fmt::print("by the law of '{}' pressed from all sides; error bound of the forces (95 %, to a density of 0.9): {}\n", law.name,
        std::isfinite(error) ? percent(error) : "not stated");
  RunResult result = granulaw::press_by_law(wall, m.particle.radius, plan_by_planes(r, m.particle));
  if (r.run.json && std::isfinite(error)) result.summary.error_estimate = error;
  r.run.grid = "law";
  report(r.run, m, result);
}

void press(PressRequest r)
{
  if (!r.planes.empty() || r.by == "law") require_three_dimensions(r.run, r.planes.empty() ? "--by law" : "--planes");
  check(r);
  const Meeting m = read_meeting(r.run);
  if (m.partner.attraction.work > 0 && r.by == "law") fail("--work-of-adhesion", "is computed by --by solver");
  check_numbers(r);
  if (r.by == "law") return press_by_law(r, m);
  if (!r.law.empty()) fail("--law", "needs --by law", r.law);
  const PressPlan plan = plan_of(r, m.particle);
  print_setting(r.run, m.particle, 0);
  const RunIdentity asked{{"command", "press"}, {"--depth", fmt::format("{}", r.depth)}, {"--support", r.support}, {"--ramp", fmt::format("{}", r.ramp.value_or(0))}};
  if (in_three_dimensions(r.run, m.particle))
    return press_by_planes(r, m, asked, [&](const RunIdentity& identity, const Run& run) { run_and_report(r.run, m, identity, true, run); });
  run_and_report(r.run, m, asked, true, [&](const RunOptions& options) { return granulaw::press(m.particle, plan, m.partner, options); });
}

void define(Options& command)
{
  const auto r = std::make_shared<PressRequest>();
  r->run.add_to(command);
  command.add_option("--depth", r->depth, "deepest overlap, as a fraction of the radius").required();
  command.add_option("--support", r->support, "free (as in a collision) or midplane (as in finite-element references)");
  command.add_option(
      "--ramp", r->ramp, "loading time in R/c*, c* = sqrt(E*/rho), 1 to 1e6 (default: long enough for the rate-independent law, 60 or more where the material yields)");
  command.add_option("--planes", r->planes,
      "three dimensions: planes that press the body, by name (pair, cube, die, bcc, fcc) or in a FILE (default: pair). A line of the file for each: nx ny nz [distance speed friction]. The normal n points from the body to the plane, in the body's frame. The distance from the origin is in m, or touch. The speed is the plane's way over --depth (1), friction is Coulomb's coefficient (0)");
  command
      .add_option("--by", r->by,
          "solver; or law, in milliseconds: a sphere between planes by the law of a particle that is pressed from all sides. The law has no friction")
      .among({"solver", "law"});
  command.add_option("--law", r->law, "of --by law: a law file; without it the atlas's law of the material");
  command.callback([r] { press(*r); });
}

}  // namespace of_press

extern const Command press_command{"press",
    "Presses a particle slowly onto a wall or another particle, and takes it off again: the quasi-static law.\n"
    "Example: mpm press materials.toml --particle grain --depth 0.02 --support midplane -o trace.csv",
    of_press::define};

}  // namespace granulaw
