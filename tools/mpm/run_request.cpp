#include "run_request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "adhesion_options.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "material_file/materials_file.hpp"
#include "option_checks.hpp"
#include "run_files/field_file.hpp"
#include "solver/run/axisymmetric_setup.hpp"

namespace granulaw {

GridKind grid_of(const std::string& name)
{
  for (const GridKind grid : {GridKind::automatic, GridKind::mapped, GridKind::rectilinear, GridKind::updated, GridKind::spatial})
    if (name == name_of(grid)) return grid;
  fail("--grid", "unknown grid", name, "auto, mapped, rectilinear, updated, rectilinear-3d");
}

namespace {

bool same_file(const std::string& a, const std::filesystem::path& b) { return std::filesystem::weakly_canonical(a) == std::filesystem::weakly_canonical(b); }

void check_numbers(const RunRequest& r)
{
  if (!(r.courant >= 0.05 && r.courant <= 1.0))
    fail("--courant", r.courant > 1 ? "explicit time stepping is unstable above 1" : "cannot be used", fmt::format("{:g}", r.courant), "0.05 to 1");
  if (r.shifted_grids) require(*r.shifted_grids >= 1 && *r.shifted_grids <= 64, "--shifted-grids (--phases)", std::to_string(*r.shifted_grids), "1 to 64 shifted grids");
  if (r.tolerance) require(*r.tolerance >= 1e-4 && *r.tolerance <= 0.5, "--tolerance", fmt::format("{:g}", *r.tolerance), "1e-4 to 0.5");
  if (r.resolution) require(*r.resolution >= 6 && *r.resolution <= 200, "--resolution", std::to_string(*r.resolution), "6 to 200 cells across the contact block");
}

void check_checkpoint(const RunRequest& r)
{
  require_writable(r.checkpoint, "--checkpoint");
  if (!r.fields.empty()) fail("--checkpoint", "cannot go with --fields: the frames of a run that was stopped are not kept");
  if (!r.output.empty() && same_file(r.checkpoint, r.output)) fail("--checkpoint", "would be the file of the trace, -o", r.output, "another name");
}

void check_fields(const RunRequest& r)
{
  check_field_output(r.fields);
  if (same_file(r.output, std::filesystem::path(r.fields).replace_extension(".h5"))) fail("--fields", "its HDF5 file would be the trace's, -o", r.output, "another name");
}

void add_bodies(Options& command, RunRequest& r)
{
  command.add_option("MATERIALS", r.materials, "TOML file with [material.NAME] and [particle.NAME]").required();
  command.add_option("--particle", r.particle, "particle of that file").required();
  command.add_option("--against", r.against, "a second particle of that file, hit pole against pole");
  command.add_option("--wall", r.wall, "a material of that file: a thick deformable wall of it (default: rigid)");
}

void add_accuracy(Options& command, RunRequest& r)
{
  command.add_option("--grid", r.grid,
      "mapped (fitted to the sphere); rectilinear (graded: any shape, layers, inclusions); updated (moving points: an independent check). Three dimensions, any shape, side and friction: rectilinear-3d. The default is as particle and partner require");
  command.add_option("--precision", r.precision, "of the material points: double (default) or single");
  const Option with_resolution =
      command.add_option("--resolution", r.resolution, "cells across the contact block, 6 to 200 (default: the run's own; in three dimensions 8)");
  command
      .add_option("--tolerance", r.tolerance,
          "relative error of F_max and e to reach, such as 0.01: resolution, time step and ramp are refined until the run's own estimate meets it")
      .excludes(with_resolution);
}

void add_outputs(Options& command, RunRequest& r)
{
  command.add_option("-o,--output", r.output, "trace of the run: NAME.csv or NAME.h5");
  const Option with_fields = command.add_option("--fields", r.fields, "the deformed body over time for ParaView: NAME.xdmf, and NAME.h5 beside it");
  command.add_option("--frames", r.frames, "about so many moments in it, 2 to 10000 (default 40)").check(whole_from_to(2, 10000)).needs(with_fields);
  const Option with_checkpoint = command.add_option("--checkpoint", r.checkpoint,
      "file of the state of the run. After a stop or a kill the same command goes on from there, with the identical trace. The file is removed when the outputs are written");
  command.add_option("--checkpoint-every", r.checkpoint_every, "seconds between two states (default 30; 0: at every sample of the trace)")
      .check(from_to(0, 86400))
      .needs(with_checkpoint);
}

void add_effort(Options& command, RunRequest& r)
{
  command.add_option("--jobs", r.jobs, "threads (default 1)").check(whole_from_to(1, 256));
  command.add_option("--shifted-grids,--phases", r.shifted_grids,
      "runs on grids shifted against each other by equal parts of a cell, 1 to 64 (default 4; in three dimensions 1). Their mean is free of the first harmonics of the contact-edge grid noise");
  command.add_option("--courant", r.courant, "time step over its stability limit, 0.05 to 1 (default 0.85); above 1 explicit time stepping is unstable");
  command.add_flag("--no-estimate", r.no_estimate, "leave out the second, coarser run that the error estimate needs (a third of the time)");
}

}  // namespace

void RunRequest::add_to(Options& command)
{
  add_bodies(command, *this);
  add_accuracy(command, *this);
  add_outputs(command, *this);
  add_effort(command, *this);
  define_adhesion(command, attraction);
  command.add_flag("--json", json, "print one JSON object instead of the summary, SI units (keys: docs/reference/commands.md)");
}

void RunRequest::check() const
{
  grid_of(grid);
  if (precision != "double" && precision != "single") fail("--precision", "unknown precision", precision, "double, single");
  if (!against.empty() && !wall.empty()) fail("--wall", "cannot go with --against: one partner only");
  check_numbers(*this);
  check_output("-o", output, ".csv, .h5");
  if (!checkpoint.empty()) check_checkpoint(*this);
  if (!fields.empty()) check_fields(*this);
}

RunOptions RunRequest::options(bool three_dimensions) const
{
  RunOptions options;
  options.resolution = resolution.value_or(0);
  options.grid = grid_of(grid);
  options.precision = precision == "single" ? Precision::single : Precision::full;
  options.threads = jobs;
  // one grid of 8 cells leaves 2 % or so; four cost four times as much and take half of the noise off
  options.shifted_grids = shifted_grids.value_or(three_dimensions ? 1 : options.shifted_grids);
  options.courant = courant;
  options.estimate_error = !no_estimate;
  return options;
}

namespace {

/// The command's, else that of the materials: 2 sqrt(gamma_a gamma_b), with a rigid plane of the particle's own surface energy.
Attraction attraction_of(const RunRequest& r, const Meeting& m)
{
  const Material& own = m.particle.materials.front();
  const Material& other = m.partner.particle ? m.partner.particle->materials.front() : m.partner.wall ? *m.partner.wall : own;
  Attraction attraction = r.attraction;
  if (attraction.work > 0) return attraction;
  attraction.work = 2 * std::sqrt(own.surface_energy * other.surface_energy);
  if (own.adhesion_range > 0) attraction.range = own.adhesion_range;
  return attraction;
}

}  // namespace

Meeting read_meeting(const RunRequest& r)
{
  const MaterialsFile file = read_materials(r.materials);
  Meeting meeting{file.particle(r.particle), {}};
  if (!r.against.empty()) meeting.partner.particle = file.particle(r.against);
  if (!r.wall.empty()) meeting.partner.wall = file.material(r.wall);
  meeting.partner.attraction = attraction_of(r, meeting);
  return meeting;
}

void require_three_dimensions(RunRequest& r, const std::string& option)
{
  if (r.grid != "auto" && r.grid != name_of(GridKind::spatial))
    fail("--grid", fmt::format("{} needs three dimensions", option), r.grid, fmt::format("{}, or no --grid", name_of(GridKind::spatial)));
  r.grid = name_of(GridKind::spatial);
}

bool in_three_dimensions(const RunRequest& r, const Particle& particle)
{
  if (grid_name(r, particle) != name_of(GridKind::spatial)) {
    if (particle.shape) fail("--grid", "a body of any shape needs three dimensions", r.grid, fmt::format("{}, or no --grid", name_of(GridKind::spatial)));
    return false;
  }
  if (!r.against.empty() || !r.wall.empty())
    fail(r.against.empty() ? "--wall" : "--against", "three dimensions know rigid planes only; leave it out, or take a body of revolution that hits along its axis");
  return true;
}

std::string grid_name(const RunRequest& r, const Particle& particle)
{
  if (r.grid != "auto") return r.grid;
  return name_of(choose_grid(particle).grid);
}

}  // namespace granulaw
