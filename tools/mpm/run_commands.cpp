// mpm impact, mpm press: one run of the solver against a rigid wall.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "commands.hpp"
#include "field_file.hpp"
#include "materials_file.hpp"
#include "solver/runs.hpp"
#include "terminal.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

/// What both commands take.
struct RunRequest
{
  std::string materials, particle, grid = "mapped", output, fields, support = "free";
  double velocity = 0, depth = 0, tolerance = 0, ramp = 0;
  double courant = RunOptions{}.courant;
  int resolution = 0, jobs = 1, frames = 40, phases = RunOptions{}.phases;
  bool json = false;
};

void add_common(CLI::App& command, RunRequest& r)
{
  command.add_option("MATERIALS", r.materials, "TOML file with [material.NAME] and [particle.NAME]")
      ->required();
  command.add_option("--particle", r.particle, "particle of that file")->required();
  command.add_option("--grid", r.grid, "reference grid: mapped (tartan and updated come in a later version)");
  auto* resolution = command.add_option("--resolution", r.resolution,
                                        "cells across the contact block, 6 to 200 (default: the run's own)");
  command
      .add_option("--tolerance", r.tolerance,
                  "relative error of force and e to reach, such as 0.01: the resolution is "
                  "doubled until two resolutions agree so well")
      ->excludes(resolution);
  command.add_option("-o,--output", r.output, "trace of the run: NAME.csv or NAME.h5");
  auto* fields = command.add_option(
      "--fields", r.fields, "the deformed body over time for ParaView: NAME.xdmf, and NAME.h5 beside it");
  command.add_option("--frames", r.frames, "about so many moments in it, 2 to 10000 (default 40)")
      ->check(CLI::Range(2, 10000))
      ->needs(fields);
  command.add_option("--jobs", r.jobs, "threads (default 1)")->check(CLI::Range(1, 256));
  command.add_option(
      "--phases", r.phases,
      "runs on grids shifted against each other by equal parts of a cell, 1 to 64; results are "
      "their mean, free of the first harmonics of the contact-edge ripple (default 4)");
  command.add_option("--courant", r.courant,
                     "time step over its stability limit, 0.05 to 1 (default 0.85); above 1 explicit time "
                     "stepping is unstable");
  command.add_flag("--json", r.json,
                   "print one JSON object instead of the summary, SI units; in it, e is corrected for the "
                   "contact-edge ripple if there is one grid only, e_raw is not; ripple: rms of raw over "
                   "smoothed force, less 1; energy_error: |kinetic + elastic + plastic energy - work put in| "
                   "over the energy put in, at the end, the largest of the grids");
}

void check(const RunRequest& r)
{
  if (r.grid == "tartan" || r.grid == "updated")
    fail("--grid", fmt::format("'{}' is not in this version yet", r.grid), {}, "mapped");
  if (r.grid != "mapped")
    fail("--grid", "unknown grid", r.grid, "mapped, tartan, updated (this version: mapped)");
  if (!(r.courant >= 0.05 && r.courant <= 1.0))
    fail("--courant", r.courant > 1 ? "explicit time stepping is unstable above 1" : "cannot be used",
         fmt::format("{:g}", r.courant), "0.05 to 1");
  if (r.phases < 1 || r.phases > 64)
    fail("--phases", "cannot be used", std::to_string(r.phases), "1 to 64 shifted grids");
  if (r.tolerance != 0 && !(r.tolerance >= 1e-4 && r.tolerance <= 0.5))
    fail("--tolerance", "cannot be used", fmt::format("{:g}", r.tolerance), "1e-4 to 0.5");
  check_output(r.output, ".csv, .h5");
  if (r.fields.empty()) return;
  check_field_output(r.fields);
  if (std::filesystem::weakly_canonical(r.output) ==
      std::filesystem::weakly_canonical(r.fields).replace_extension(".h5"))
    fail("--fields", "its HDF5 file would be the trace's, -o", r.output, "another name");
}

/// Runs at the resolution asked for, or doubles it until the tolerance is met (at most twice).
RunResult run_to_tolerance(const RunRequest& r, const FieldObserver& fields,
                           const std::function<RunResult(const RunOptions&)>& run)
{
  ProgressBar bar;
  RunOptions options;
  options.resolution = r.resolution;
  options.threads = r.jobs;
  options.phases = r.phases;
  options.courant = r.courant;
  options.fields = fields;
  options.progress = [&](double done) {
    bar.update(done, options.resolution ? fmt::format("resolution {}", options.resolution) : "");
  };
  options.estimate_error = r.tolerance > 0;
  if (r.tolerance <= 0) return run(options);
  RunResult result;
  for (const int resolution : {16, 32, 64}) {
    options.resolution = resolution;
    result = run(options);
    if (result.summary.error_estimate <= r.tolerance) return result;
  }
  fmt::print(stderr, "mpm: tolerance {:.2g} not reached: the estimate at resolution 64 is {:.2g}\n",
             r.tolerance, result.summary.error_estimate);
  return result;
}

RunResult run_as_asked(const RunRequest& r, const std::function<RunResult(const RunOptions&)>& run)
{
  if (r.fields.empty()) return run_to_tolerance(r, {}, run);
  return run_with_fields(r.fields, r.frames,
                         [&](const FieldObserver& fields) { return run_to_tolerance(r, fields, run); });
}

void print_json(const RunSummary& s)
{
  nlohmann::ordered_json out;
  out["e"] = s.restitution;
  out["e_raw"] = s.restitution_raw;
  out["force_max_N"] = s.force_max;
  out["delta_max_m"] = s.delta_max;
  out["delta_residual_m"] = s.delta_residual;
  out["contact_time_s"] = s.contact_time;
  out["work_load_J"] = s.work_load;
  out["work_unload_J"] = s.work_unload;
  out["energy_error"] = s.energy_error;
  out["ripple"] = s.ripple;
  out["points"] = s.points;
  out["steps"] = s.steps;
  out["cpu_s"] = s.cpu_s;
  out["point_updates_per_s"] = s.point_updates_per_s;
  if (s.error_estimate > 0)
    out["error_estimate"] = s.error_estimate;
  else
    out["error_estimate"] = nullptr;
  fmt::print("{}\n", out.dump(2));
}

void report(const RunRequest& r, const Sphere& sphere, const RunResult& result)
{
  if (!r.output.empty()) write_trace(result, r.output);
  const RunSummary& s = result.summary;
  if (r.json) return print_json(s);
  fmt::print("coefficient of restitution e   {:.4f}\n", s.restitution);
  fmt::print("largest force                  {:.5g} N\n", s.force_max);
  fmt::print("largest overlap                {:.5g} m  ({:.4g} R)\n", s.delta_max,
             s.delta_max / sphere.radius);
  fmt::print("residual overlap               {:.5g} m\n", s.delta_residual);
  fmt::print("contact time                   {:.5g} s\n", s.contact_time);
  fmt::print("work put in, given back        {:.5g} J, {:.5g} J\n", s.work_load, s.work_unload);
  if (s.error_estimate > 0) fmt::print("error, from two resolutions    {:.2g}\n", s.error_estimate);
  fmt::print("{} points, {} steps, {:.2f} CPU s, {:.1f} million point updates a second\n", s.points, s.steps,
             s.cpu_s, 1e-6 * s.point_updates_per_s);
  if (!r.output.empty()) fmt::print("wrote {}\n", r.output);
  if (!r.fields.empty()) fmt::print("wrote {}\n", r.fields);
}

void print_setting(const RunRequest& r, const Sphere& sphere)
{
  if (r.json) return;
  const Material& m = sphere.material;
  fmt::print("sphere of {:.4g} m radius, E* = {:.4g} Pa", sphere.radius, m.e_star());
  if (m.yields()) {
    const double v_y = yield_velocity(m.e_star(), m.yield_stress, m.density);
    fmt::print(", E*/Y = {:.4g}, yield velocity V_y = {:.4g} m/s", m.e_star() / m.yield_stress, v_y);
    if (r.velocity > 0)
      fmt::print(", V/V_y = {:.4g}, I = rho V^2/Y = {:.3g}", r.velocity / v_y,
                 m.density * r.velocity * r.velocity / m.yield_stress);
  } else {
    fmt::print(", elastic");
  }
  fmt::print("\n");
}

}  // namespace

void add_impact(CLI::App& app)
{
  const auto r = std::make_shared<RunRequest>();
  CLI::App* command =
      app.add_subcommand("impact",
                         "A sphere hits a rigid wall: e, force, overlap, contact time.\n"
                         "Example: mpm impact materials.toml --particle grain --velocity 1.0 -o trace.csv");
  add_common(*command, *r);
  command->add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command->callback([r] {
    check(*r);
    const Sphere sphere = read_materials(r->materials).sphere(r->particle);
    if (!(r->velocity > 0 && std::isfinite(r->velocity)))
      fail("--velocity", "cannot be used", fmt::format("{:g} m/s", r->velocity), "over 0");
    print_setting(*r, sphere);
    report(*r, sphere,
           run_as_asked(*r, [&](const RunOptions& o) { return run_impact(sphere, r->velocity, o); }));
  });
}

void add_press(CLI::App& app)
{
  const auto r = std::make_shared<RunRequest>();
  CLI::App* command = app.add_subcommand(
      "press",
      "A sphere is pressed slowly onto a rigid wall and taken off again: the rate-free law.\n"
      "Example: mpm press materials.toml --particle grain --depth 0.02 --support midplane -o trace.csv");
  add_common(*command, *r);
  command->add_option("--depth", r->depth, "deepest overlap, as a share of the radius")->required();
  command->add_option("--support", r->support,
                      "free (as in a collision) or midplane (as in finite-element references)");
  command->add_option("--ramp", r->ramp,
                      "loading time in R/c*, c* = sqrt(E*/rho), 1 to 1e6 (default: long enough for the "
                      "rate-free law, 60 or more where the material yields)");
  command->callback([r] {
    check(*r);
    if (r->support != "free" && r->support != "midplane")
      fail("--support", "unknown support", r->support, "free, midplane");
    const Sphere sphere = read_materials(r->materials).sphere(r->particle);
    if (!(r->depth > 0 && r->depth <= 0.8))
      fail("--depth", "cannot be used", fmt::format("{:g} (a share of the radius)", r->depth),
           "over 0, up to 0.8");
    if (r->ramp != 0 && !(r->ramp >= 1 && r->ramp <= 1e6))
      fail("--ramp", "cannot be used", fmt::format("{:g} R/c*", r->ramp), "1 to 1e6");
    PressPlan plan;
    plan.ramp = r->ramp;
    plan.depth = r->depth * sphere.radius;
    plan.support = r->support == "free" ? Support::free : Support::midplane;
    print_setting(*r, sphere);
    report(*r, sphere, run_as_asked(*r, [&](const RunOptions& o) { return run_press(sphere, plan, o); }));
  });
}

}  // namespace granulaw
