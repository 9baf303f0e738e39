// mpm compact: a packing of deformable spheres pressed by the solver, every sphere with a grid of its own.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "material_file/materials_file.hpp"
#include "material_file/packing_file.hpp"
#include "option_checks.hpp"
#include "run_files/checkpoint_file.hpp"
#include "solver/run/compact.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_compact {

struct CompactRequest
{
  std::string packing, materials;
  std::vector<std::string> by_type;
  std::string box = "periodic", precision = "double", contacts, output, checkpoint;
  CompactPlan plan;
  std::optional<double> unload_to;
  double courant = RunOptions{}.courant, checkpoint_every = 30;
  int jobs = 1;
  bool json = false;
};

constexpr const char* walls[] = {"-x", "+x", "-y", "+y", "floor", "lid"};

double mean_stress(const CompactRow& row) { return (row.stress[0] + row.stress[1] + row.stress[2]) / 3; }

void check(const CompactRequest& r)
{
  check_output("-o", r.output, ".csv");
  check_output("--contacts", r.contacts, ".csv");
  if (!r.checkpoint.empty()) require_writable(r.checkpoint, "--checkpoint");
}

std::string rows_csv(const CompactResult& result, bool with_walls)
{
  std::string text =
      "branch,density,stress_Pa,stress_xx_Pa,stress_yy_Pa,stress_zz_Pa,coordination,box_x_m,box_y_m,box_z_m,work_J,kinetic_J,elastic_J,plastic_J,contact_J";
  if (with_walls)
    for (const char* name : walls) text += fmt::format(",force_{}_N", name);
  text += "\n";
  for (const CompactRow& row : result.rows) {
    text += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.5g},{:.7g},{:.7g},{:.7g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", row.unloading ? "unload" : "load",
        row.density, mean_stress(row), row.stress[0], row.stress[1], row.stress[2], row.coordination, row.box[0], row.box[1], row.box[2], row.work, row.kinetic,
        row.elastic, row.plastic, row.lost_in_contact);
    if (with_walls)
      for (const double force : row.wall_force) text += fmt::format(",{:.6g}", force);
    text += "\n";
  }
  return text;
}

std::string contacts_csv(const CompactResult& result)
{
  std::string text = "branch,density,sphere,other,image_x,image_y,image_z,normal_N,tangential_N,distance_m,area_m2\n";
  for (const CompactContact& c : result.contacts)
    text += fmt::format("{},{:.6g},{},{},{},{},{},{:.6g},{:.6g},{:.8g},{:.6g}\n", c.unloading ? "unload" : "load", c.density, c.sphere + 1,
        c.other < 0 ? walls[-1 - c.other] : std::to_string(c.other + 1), c.image[0], c.image[1], c.image[2], c.normal, c.tangential, c.distance, c.area);
  return text;
}

/// Of each row, one number.
nlohmann::ordered_json column(const CompactResult& result, const std::function<double(const CompactRow&)>& of)
{
  nlohmann::ordered_json values = nlohmann::ordered_json::array();
  for (const CompactRow& row : result.rows) values.push_back(json_number(of(row)));
  return values;
}

void print_as_json(const CompactRequest& r, const CompactResult& result, std::size_t bodies)
{
  nlohmann::ordered_json out;
  out["branch"] = nlohmann::ordered_json::array();
  for (const CompactRow& row : result.rows) out["branch"].push_back(row.unloading ? "unload" : "load");
  out["density"] = column(result, [](const CompactRow& row) { return row.density; });
  out["stress_Pa"] = column(result, mean_stress);
  constexpr const char* axes[] = {"xx", "yy", "zz"};
  for (int d = 0; d < 3; ++d) out[fmt::format("stress_{}_Pa", axes[d])] = column(result, [d](const CompactRow& row) { return row.stress[d]; });
  out["wall_force_N"] = nlohmann::ordered_json::array();
  if (r.plan.walls) {
    for (const CompactRow& row : result.rows) out["wall_force_N"].push_back(row.wall_force);
    for (int d = 0; d < 3; ++d) out[fmt::format("wall_stress_{}_Pa", axes[d])] = column(result, [d](const CompactRow& row) { return row.wall_stress[d]; });
  }
  out["coordination"] = column(result, [](const CompactRow& row) { return row.coordination; });
  out["box_m"] = nlohmann::ordered_json::array();
  for (const CompactRow& row : result.rows) out["box_m"].push_back(row.box);
  out["work_J"] = column(result, [](const CompactRow& row) { return row.work; });
  out["kinetic_J"] = column(result, [](const CompactRow& row) { return row.kinetic; });
  out["elastic_J"] = column(result, [](const CompactRow& row) { return row.elastic; });
  out["plastic_J"] = column(result, [](const CompactRow& row) { return row.plastic; });
  out["contact_J"] = column(result, [](const CompactRow& row) { return row.lost_in_contact; });
  out["energy_error"] = result.energy_error;
  out["created_in_contact"] = result.largest_created;
  if (!r.plan.walls) out["momentum_error"] = result.momentum;
  out["start_overlaps"] = result.start_overlaps;
  out["start_overlap_max"] = result.largest_start_overlap;
  out["bodies"] = bodies;
  out["points"] = result.points;
  out["steps"] = result.steps;
  out["cpu_s"] = result.cpu_s;
  print_json(out);
}

void print(const CompactRequest& r, const CompactResult& result)
{
  fmt::print("{:>8} {:>12} {:>12} {:>12} {:>12} {:>6}", "density", "stress Pa", "xx", "yy", "zz", "Z");
  if (r.plan.walls) fmt::print(" {:>11} {:>11} {:>11}", "lid N", "floor N", "sides N");
  fmt::print("\n");
  for (const CompactRow& row : result.rows) {
    fmt::print("{:>8.4f} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} {:>6.2f}", row.density, mean_stress(row), row.stress[0], row.stress[1], row.stress[2], row.coordination);
    const auto& f = row.wall_force;
    if (r.plan.walls) fmt::print(" {:>11.5g} {:>11.5g} {:>11.5g}", f[5], f[4], (f[0] + f[1] + f[2] + f[3]) / 4);
    fmt::print("{}\n", row.unloading ? "  back" : "");
  }
  if (!result.rows.empty()) {
    const CompactRow& end = result.rows.back();
    fmt::print("work of the sides {:.5g} J: plastic {:.1f} %, elastic {:.1f} %, kinetic {:.1f} %, contact {:.1f} %; balance within {:.2g}\n", end.work,
        100 * end.plastic / end.work, 100 * end.elastic / end.work, 100 * end.kinetic / end.work, 100 * end.lost_in_contact / end.work, result.energy_error);
  }
  if (result.start_overlaps > 0)
    fmt::print("{} contacts overlapped at the start, by {:.2g} of the radius at most\n", result.start_overlaps, result.largest_start_overlap);
  fmt::print("{} points, {} steps, {:.1f} CPU s\n", result.points, result.steps, result.cpu_s);
  for (const std::string& file : {r.output, r.contacts})
    if (!file.empty()) fmt::print("wrote {}\n", file);
}

/// All that the results depend on.
RunIdentity identity(const CompactRequest& r, const PackingFile& file)
{
  const CompactPlan& p = r.plan;
  RunIdentity asked{{"command", "compact"}, {"--box", r.box}, {"--friction", fmt::format("{}", p.friction)}, {"--density", fmt::format("{}", p.density)},
      {"--unload-to", fmt::format("{}", p.unload_to)}, {"--cells", fmt::format("{}", p.cells)}, {"--rate", fmt::format("{}", p.rate)},
      {"--seed", fmt::format("{}", p.seed)}, {"--precision", r.precision}};
  std::string spheres;
  for (const Packing::Sphere& s : file.packing.spheres) spheres += fmt::format("{} {} {} {} {} ", s.centre[0], s.centre[1], s.centre[2], s.radius, s.material);
  for (const double side : file.packing.box) spheres += fmt::format("{} ", side);
  asked.emplace_back("PACKING", spheres);
  Particle all = Particle::sphere(1, file.materials.front());
  all.materials = file.materials;
  RunOptions options;
  options.courant = r.courant;
  return identity_of(std::move(asked), all, {}, options);
}

void run(CompactRequest r)
{
  check(r);
  r.plan.walls = r.box == "walls";
  r.plan.unload_to = r.unload_to.value_or(-1);
  const PackingFile file = read_packing(r.packing, read_materials(r.materials), r.by_type);
  if (!r.json)
    fmt::print("{} spheres in a box of {:.4g} x {:.4g} x {:.4g} m, {}\n", file.packing.spheres.size(), file.packing.box[0], file.packing.box[1], file.packing.box[2],
        r.plan.walls ? "six walls: the lid (+z) comes down" : "periodic: all sides close in");
  RunOptions options;
  options.courant = r.courant, options.threads = r.jobs;
  options.precision = r.precision == "single" ? Precision::single : Precision::full;
  ProgressBar bar;
  options.progress = [&](double done) { bar.update(done, ""); };
  std::optional<CheckpointFile> checkpoint;
  if (!r.checkpoint.empty()) {
    checkpoint.emplace(r.checkpoint, r.checkpoint_every, identity(r, file), is_interrupted);
    if (checkpoint->was_found() && !r.json) fmt::print("goes on from {}\n", r.checkpoint);
    options.checkpoints = checkpoint->store();
  }
  const CompactResult result = compact(file.packing, file.materials, r.plan, options);
  bar.clear();
  if (!r.output.empty()) write_text_atomically(r.output, rows_csv(result, r.plan.walls));
  if (!r.contacts.empty()) write_text_atomically(r.contacts, contacts_csv(result));
  if (r.json)
    print_as_json(r, result, file.packing.spheres.size());
  else
    print(r, result);
  if (checkpoint) checkpoint->remove();
}

void define(Options& command)
{
  const auto r = std::make_shared<CompactRequest>();
  command
      .add_option(
          "PACKING", r->packing, "lines x y z radius [material], m, behind a first line # box LX LY LZ (from 0). Or a LIGGGHTS dump (its last frame) or data file")
      .required();
  command.add_option("MATERIALS", r->materials, "TOML file with [material.NAME]; with one of them PACKING needs no names").required();
  command.add_option("--materials", r->by_type, "materials of a LIGGGHTS file's atom types, in order").list();
  command.add_option("--box", r->box, "periodic: all sides close in (default). walls: a die of six walls, the lid (+z) comes down").among({"periodic", "walls"});
  command.add_option("--friction", r->plan.friction, "Coulomb's coefficient of all contacts (default 0)").check(from_to(0, 10));
  command.add_option("--density", r->plan.density, "the end: volume of the undeformed spheres over that of the box").check(above_zero_to(1.1)).capture_default_str();
  command.add_option("--unload-to", r->unload_to, "then the sides go back until the stress (walls: on the lid) is this fraction of the largest").check(from_to(0, 0.99));
  command.add_option("--cells", r->plan.cells, "cells of the grids to a diameter. Stress within 2 % by 6, 1 % by 8 above a density of 0.7; 5 and 3 % at 0.63").check(whole_from_to(4, 40)).capture_default_str();
  command.add_option("--rate", r->plan.rate, "dL/dt = -RATE c*/R L, c* = sqrt(E*/rho), R the mean radius. With 0.001 the stress is 1 to 2 % high, with 0.002 twice that")
      .check(above_zero_to(0.05))
      .capture_default_str();
  command.add_option("--seed", r->plan.seed, "of the turns of the grids, for the scatter that they cause").check(whole_from_to(1, 1000000)).capture_default_str();
  command.add_option("--precision", r->precision, "of the material points: double (default) or single").among({"double", "single"});
  command.add_option("--courant", r->courant, "time step over its measured stability limit").check(from_to(0.05, 0.95)).capture_default_str();
  command.add_option("--jobs", r->jobs, "threads; the results have the same bits with any number (default 1)").check(whole_from_to(1, 256));
  command.add_option("-o,--output", r->output, "a row for each window of density: NAME.csv");
  command.add_option("--contacts", r->contacts, "forces and areas of all contacts, in each window: NAME.csv");
  const Option with_checkpoint = command.add_option("--checkpoint", r->checkpoint,
      "file of the state of the run. After a stop or a kill the same command goes on from there, with identical results. The file is removed when the outputs are written");
  command.add_option("--checkpoint-every", r->checkpoint_every, "seconds between two states (default 30)").check(from_to(0, 86400)).needs(with_checkpoint);
  command.add_flag("--json", r->json, "print one JSON object instead of the table, SI units (keys: docs/reference/commands.md)");
  command.callback([r] { run(*r); });
}

}  // namespace of_compact

extern const Command compact_command{"compact",
    "Presses a packing of deformable spheres: stress, wall forces and contacts of a bed, without a contact law.\n"
    "Every sphere has a grid of its own. A bed of 1000 takes one or two CPU minutes at 6 cells (docs/evidence/packings.md).\n"
    "Example: mpm compact packing.txt materials.toml --friction 0.3 --density 0.95 --jobs 4 -o pressed.csv",
    of_compact::define};

}  // namespace granulaw
