// mpm impact, mpm press: one run of the solver against a rigid wall.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/scales.hpp"
#include "checkpoint_file.hpp"
#include "collision_report.hpp"
#include "commands.hpp"
#include "field_file.hpp"
#include "materials_file.hpp"
#include "option_checks.hpp"
#include "solver/accuracy.hpp"
#include "solver/scene_builder.hpp"
#include "terminal.hpp"
#include "trace_file.hpp"

namespace granulaw {

namespace {

/// What both commands take.
struct RunRequest
{
  std::string materials, particle, against, wall, grid = "auto", precision = "double", output, fields,
                                                  checkpoint, support = "free";
  double velocity = 0, depth = 0, checkpoint_every = 30;
  double courant = RunOptions{}.courant;
  std::optional<double> tolerance, ramp;
  std::optional<int> resolution;
  int jobs = 1, frames = 40, shifted_grids = RunOptions{}.shifted_grids;
  bool json = false, no_estimate = false;
};

void add_common(CLI::App& command, RunRequest& r)
{
  command.add_option("MATERIALS", r.materials, "TOML file with [material.NAME] and [particle.NAME]")
      ->required();
  command.add_option("--particle", r.particle, "particle of that file")->required();
  command.add_option("--against", r.against, "a second particle of that file, hit pole against pole");
  command.add_option("--wall", r.wall,
                     "a material of that file: a thick deformable wall of it (default: rigid)");
  command.add_option(
      "--grid", r.grid,
      "mapped (fitted to the sphere), rectilinear or tartan (graded: any shape, layers, inclusions), "
      "updated (points move through the grid: the independent check); default: what the particle "
      "needs");
  command.add_option("--precision", r.precision, "of the material points: double (default) or single");
  auto* resolution = command.add_option("--resolution", r.resolution,
                                        "cells across the contact block, 6 to 200 (default: the run's own)");
  command
      .add_option("--tolerance", r.tolerance,
                  "relative error of F_max and e to reach, such as 0.01: resolution, time step and ramp are "
                  "refined until the run's own estimate meets it")
      ->excludes(resolution);
  command.add_option("-o,--output", r.output, "trace of the run: NAME.csv or NAME.h5");
  auto* fields = command.add_option(
      "--fields", r.fields, "the deformed body over time for ParaView: NAME.xdmf, and NAME.h5 beside it");
  command.add_option("--frames", r.frames, "about so many moments in it, 2 to 10000 (default 40)")
      ->check(whole_from_to(2, 10000))
      ->needs(fields);
  auto* checkpoint = command.add_option(
      "--checkpoint", r.checkpoint,
      "keeps the state of the run in this file; the same command goes on from there after it was stopped or "
      "killed, with the identical trace. The file is removed when the run is finished and its outputs are "
      "written");
  command
      .add_option("--checkpoint-every", r.checkpoint_every,
                  "seconds between two states (default 30; 0: at every sample of the trace)")
      ->check(from_to(0, 86400))
      ->needs(checkpoint);
  command.add_option("--jobs", r.jobs, "threads (default 1)")->check(whole_from_to(1, 256));
  command.add_option(
      "--shifted-grids,--phases", r.shifted_grids,
      "runs on grids shifted against each other by equal parts of a cell, 1 to 64; results are "
      "their mean, free of the first harmonics of the contact-edge grid noise (default 4)");
  command.add_option("--courant", r.courant,
                     "time step over its stability limit, 0.05 to 1 (default 0.85); above 1 explicit time "
                     "stepping is unstable");
  command.add_flag("--no-estimate", r.no_estimate,
                   "leave out the second, coarser run that the error estimate needs (a third of the time)");
  command.add_flag(
      "--json", r.json,
      "print one JSON object instead of the summary, SI units; in it, e is corrected for the "
      "contact-edge grid noise if there is one grid only, e_raw is not; force_max_N: of an impact the peak "
      "of "
      "the grids' mean trace, smoothed over 2 % of the loading; of a press or one grid that of a fit; "
      "grid_noise (also ripple): rms of raw over fitted force, less 1; energy_error: |kinetic + elastic + "
      "plastic energy + "
      "contact loss "
      "- work put in| over the energy put in, at the end; contact_loss: the part of it that nodes lost "
      "when they reached the other side and stopped, proportional to the cell size; hourglass: the part "
      "that the hourglass control holds at the end; plastic_strain_max: largest equivalent plastic "
      "strain; all four are the largest of the grids");
}

GridKind grid_of(const std::string& name)
{
  if (name == "tartan") return GridKind::rectilinear;  // an alias
  for (const GridKind grid :
       {GridKind::automatic, GridKind::mapped, GridKind::rectilinear, GridKind::updated})
    if (name == name_of(grid)) return grid;
  fail("--grid", "unknown grid", name, "auto, mapped, rectilinear, updated");
}

bool same_file(const std::string& a, const std::filesystem::path& b)
{
  return std::filesystem::weakly_canonical(a) == std::filesystem::weakly_canonical(b);
}

/// Slowest impact, over the wave speed c* = sqrt(E*/rho), and shallowest press, over R: contacts of about
/// 1e-4 R. The time step goes with their cells, so smaller ones take days. Elastic there up to E*/Y = 15 000.
constexpr double slowest = 1e-10, shallowest = 1e-8;

/// `velocity` and `wave_speed` in m/s. Beyond half the wave speed the solver refuses, too.
void check_velocity(double velocity, double wave_speed)
{
  if (!(velocity > 0 && std::isfinite(velocity)))
    fail("--velocity", "cannot be used", fmt::format("{:g} m/s", velocity), "over 0");
  if (velocity > 0.5 * wave_speed)
    fail("--velocity", "is beyond what an impact of a particle can be resolved for",
         fmt::format("{:g} m/s", velocity),
         fmt::format("up to half the wave speed sqrt(E*/rho), {:.4g} m/s", 0.5 * wave_speed));
  if (velocity < slowest * wave_speed)
    fail("--velocity", "is too slow to be resolved (Hertz's law holds there)",
         fmt::format("{:g} m/s", velocity),
         fmt::format("{:g} times the wave speed sqrt(E*/rho) or more, {:.4g} m/s", slowest,
                     slowest * wave_speed));
}

void check(const RunRequest& r)
{
  grid_of(r.grid);
  if (r.precision != "double" && r.precision != "single")
    fail("--precision", "unknown precision", r.precision, "double, single");
  if (!r.against.empty() && !r.wall.empty()) fail("--wall", "cannot go with --against: one partner only");
  if (!(r.courant >= 0.05 && r.courant <= 1.0))
    fail("--courant", r.courant > 1 ? "explicit time stepping is unstable above 1" : "cannot be used",
         fmt::format("{:g}", r.courant), "0.05 to 1");
  if (r.shifted_grids < 1 || r.shifted_grids > 64)
    fail("--shifted-grids (--phases)", "cannot be used", std::to_string(r.shifted_grids),
         "1 to 64 shifted grids");
  if (r.tolerance && !(*r.tolerance >= 1e-4 && *r.tolerance <= 0.5))
    fail("--tolerance", "cannot be used", fmt::format("{:g}", *r.tolerance), "1e-4 to 0.5");
  if (r.resolution && !(*r.resolution >= 6 && *r.resolution <= 200))
    fail("--resolution", "cannot be used", std::to_string(*r.resolution),
         "6 to 200 cells across the contact block");
  check_output(r.output, ".csv, .h5");
  if (!r.checkpoint.empty()) {
    require_writable(r.checkpoint, "--checkpoint");
    if (!r.fields.empty())
      fail("--checkpoint", "cannot go with --fields: the frames of a run that was stopped are not kept");
    if (!r.output.empty() && same_file(r.checkpoint, r.output))
      fail("--checkpoint", "would be the file of the trace, -o", r.output, "another name");
  }
  if (r.fields.empty()) return;
  check_field_output(r.fields);
  if (same_file(r.output, std::filesystem::path(r.fields).replace_extension(".h5")))
    fail("--fields", "its HDF5 file would be the trace's, -o", r.output, "another name");
}

/// Runs at the resolution asked for, or to the tolerance.
RunResult run_to_request(const RunRequest& r, const FieldObserver& fields, const Run& run)
{
  ProgressBar bar;
  RunOptions options;
  options.resolution = r.resolution.value_or(0);
  options.grid = grid_of(r.grid);
  options.precision = r.precision == "single" ? Precision::single : Precision::full;
  options.threads = r.jobs;
  options.shifted_grids = r.shifted_grids;
  options.courant = r.courant;
  options.fields = fields;
  options.progress = [&](double done) { bar.update(done, ""); };
  options.estimate_error = !r.no_estimate;
  if (!r.tolerance) return run(options);
  const ToleranceResult found = run_to_tolerance(*r.tolerance, r.depth > 0, options, run);
  if (!found.reached)
    fmt::print(
        stderr,
        "mpm: tolerance {:.2g} not reached: at {} cells the estimate is {:.2g} (resolution {:.2g}, time "
        "step {:.2g}, ramp {:.2g})\n",
        *r.tolerance, found.result.summary.resolution, found.result.summary.error_estimate,
        found.resolution_error, found.step_error, found.ramp_error);
  return found.result;
}

RunResult run_as_asked(const RunRequest& r, const Run& run)
{
  if (r.fields.empty()) return run_to_request(r, {}, run);
  return run_with_fields(r.fields, r.frames,
                         [&](const FieldObserver& fields) { return run_to_request(r, fields, run); });
}

/// The grid of the (first) particle.
std::string grid_name(const RunRequest& r, const Particle& particle)
{
  if (r.grid != "auto") return r.grid;
  return name_of(choose_grid(particle).grid);
}

void print_json(const RunRequest& r, const Particle& particle, const RunSummary& s)
{
  nlohmann::ordered_json out = collision_json(s);
  put_effort(out, s.points, s.steps, s.cpu_s, s.point_updates_per_s, s.error_estimate);
  out["grid"] = grid_name(r, particle);
  out["resolution"] = s.resolution;
  out["grids"] = s.grids;
  out["energy_error"] = s.energy_error;
  out["grid_noise"] = out["ripple"] = s.grid_noise;
  out["e_raw"] = s.restitution_raw;
  out["plastic_strain_max"] = s.plastic_strain_max;
  out["contact_loss"] = s.contact_loss;
  out["hourglass"] = s.hourglass;
  fmt::print("{}\n", out.dump(2));
}

void report(const RunRequest& r, const Particle& particle, const RunResult& result)
{
  if (!r.output.empty()) write_trace(result, r.output);
  const RunSummary& s = result.summary;
  if (r.json) return print_json(r, particle, s);
  print_collision(s, fmt::format("{:.4g} R", s.delta_max / particle.radius));
  if (s.error_estimate > 0) fmt::print("estimated error of F and e     {:.2g}\n", s.error_estimate);
  fmt::print("{} points, {} steps, {:.2f} CPU s, {:.1f} million point updates a second\n", s.points, s.steps,
             s.cpu_s, 1e-6 * s.point_updates_per_s);
  if (!r.output.empty()) fmt::print("wrote {}\n", r.output);
  if (!r.fields.empty()) fmt::print("wrote {}\n", r.fields);
}

void print_setting(const RunRequest& r, const Particle& particle)
{
  if (r.json) return;
  const Material& m = particle.materials.front();
  fmt::print("{} of {:.4g} m radius, E* = {:.4g} Pa", particle.is_sphere() ? "sphere" : "body of revolution",
             particle.radius, m.e_star());
  if (m.yields()) {
    const double v_y = yield_velocity(m.e_star(), m.yield_stress, m.density);
    fmt::print(", E*/Y = {:.4g}, yield velocity V_y = {:.4g} m/s", m.e_star() / m.yield_stress, v_y);
    if (r.velocity > 0)
      fmt::print(", V/V_y = {:.4g}, I = rho V^2/Y = {:.3g}", r.velocity / v_y,
                 m.density * r.velocity * r.velocity / m.yield_stress);
  } else {
    fmt::print(", elastic");
  }
  if (r.grid == "auto") {
    fmt::print("\ngrid: {} ({})\n", grid_name(r, particle), choose_grid(particle).reason);
  } else {
    fmt::print("\ngrid: {}, as asked\n", r.grid);
  }
}

/// The particle and what it meets.
struct Meeting
{
  Particle particle;
  Partner partner;
};

/// Runs and reports. `drive`: the command and what it is told beyond RunRequest's common part.
void run_and_report(const RunRequest& r, const Meeting& m, const RunIdentity& drive, const Run& run)
{
  std::optional<CheckpointFile> checkpoint;
  const auto run_on = [&](RunOptions options) {
    if (!checkpoint && !r.checkpoint.empty()) {
      RunIdentity asked = drive;
      asked.insert(asked.end(), {{"--grid", r.grid},
                                 {"--precision", r.precision},
                                 {"--resolution", fmt::format("{}", r.resolution.value_or(0))},
                                 {"--tolerance", fmt::format("{}", r.tolerance.value_or(0))},
                                 {"--no-estimate", r.no_estimate ? "yes" : "no"}});
      checkpoint.emplace(r.checkpoint, r.checkpoint_every,
                         identity_of(std::move(asked), m.particle, m.partner, options));
      if (checkpoint->was_found() && !r.json) fmt::print("goes on from {}\n", r.checkpoint);
    }
    if (checkpoint) options.checkpoints = checkpoint->store();
    return run(options);
  };
  report(r, m.particle, run_as_asked(r, run_on));
  if (checkpoint) checkpoint->remove();
}

Meeting read_meeting(const RunRequest& r)
{
  const MaterialsFile file = read_materials(r.materials);
  Meeting meeting{file.particle(r.particle), {}};
  if (!r.against.empty()) meeting.partner.particle = file.particle(r.against);
  if (!r.wall.empty()) meeting.partner.wall = file.material(r.wall);
  return meeting;
}

}  // namespace

void add_impact(CLI::App& app)
{
  const auto r = std::make_shared<RunRequest>();
  CLI::App* command =
      app.add_subcommand("impact",
                         "A particle hits a wall, or another particle: e, force, overlap, contact time.\n"
                         "Example: mpm impact materials.toml --particle grain --velocity 1.0 -o trace.csv");
  add_common(*command, *r);
  command->add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command->callback([r] {
    check(*r);
    const Meeting m = read_meeting(*r);
    check_velocity(r->velocity, scales_of(m.particle).velocity());
    print_setting(*r, m.particle);
    const RunIdentity drive{{"command", "impact"}, {"--velocity", fmt::format("{}", r->velocity)}};
    run_and_report(*r, m, drive,
                   [&](const RunOptions& o) { return run_impact(m.particle, r->velocity, o, m.partner); });
  });
}

void add_press(CLI::App& app)
{
  const auto r = std::make_shared<RunRequest>();
  CLI::App* command = app.add_subcommand(
      "press",
      "A particle is pressed slowly onto a wall, or another particle, and taken off again: the rate-free "
      "law.\n"
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
    const Meeting m = read_meeting(*r);
    if (!(r->depth >= shallowest && r->depth <= 0.8))
      fail("--depth", "cannot be used", fmt::format("{:g} (a share of the radius)", r->depth),
           fmt::format("{:g} to 0.8", shallowest));
    if (r->ramp && !(*r->ramp >= 1 && *r->ramp <= 1e6))
      fail("--ramp", "cannot be used", fmt::format("{:g} R/c*", *r->ramp), "1 to 1e6");
    PressPlan plan;
    plan.ramp = r->ramp.value_or(0);
    plan.depth = r->depth * m.particle.radius;
    plan.support = r->support == "free" ? Support::free : Support::midplane;
    print_setting(*r, m.particle);
    const RunIdentity drive{{"command", "press"},
                            {"--depth", fmt::format("{}", r->depth)},
                            {"--support", r->support},
                            {"--ramp", fmt::format("{}", r->ramp.value_or(0))}};
    run_and_report(*r, m, drive,
                   [&](const RunOptions& o) { return run_press(m.particle, plan, o, m.partner); });
  });
}

}  // namespace granulaw
