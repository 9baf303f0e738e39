#include "run_output.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "console.hpp"
#include "law/h5.hpp"
#include "law/h5_names.hpp"

namespace granulaw::tool {

namespace {

const char* branch_name(Branch b)
{
  switch (b) {
    case Branch::load: return "load";
    case Branch::unload: return "unload";
    case Branch::reload: return "reload";
  }
  return "?";
}

nlohmann::ordered_json json_of(const RunSummary& s)
{
  return {{"e", s.restitution},
          {"force_max_N", s.force_max},
          {"delta_max_m", s.delta_max},
          {"delta_residual_m", s.delta_residual},
          {"contact_time_s", s.contact_time},
          {"work_load_J", s.work_load},
          {"work_unload_J", s.work_unload},
          {"points", s.points},
          {"steps", s.steps},
          {"cpu_s", s.cpu_s},
          {"point_updates_per_s", s.point_updates_per_s},
          {"error_estimate", s.error_estimate > 0 ? nlohmann::ordered_json(s.error_estimate) : nlohmann::ordered_json()},
          {"energy_error", s.energy_error},
          {"ripple", s.ripple}};
}

void write_csv(const RunResult& result, const std::string& path)
{
  auto out = fmt::output_file(path);
  out.print("time_s,delta_m,force_N,contact_radius_m,branch\n");
  for (const TraceSample& t : result.trace)
    out.print("{:.9e},{:.9e},{:.9e},{:.9e},{}\n", t.time, t.delta, t.force, t.contact_radius, branch_name(t.branch));
}

void write_h5(const RunResult& result, const std::string& path)
{
  const h5::Silence silence;
  const h5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (!file.ok()) fail(path, "cannot be written");
  h5::write_text_attribute(file, "format", "granulaw-trace", path);
  h5::write_text_attribute(file, "version", version(), path);
  h5::write_text_attribute(file, "git_hash", git_hash(), path);
  h5::write_text_attribute(file, "summary", json_of(result.summary).dump(), path);
  const auto column = [&](const h5::Field& field, auto&& value) {
    std::vector<double> values;
    for (const TraceSample& t : result.trace) values.push_back(value(t));
    h5::write_vector(file, field, values, path);
  };
  column({"time", "s", "since first touch"}, [](const TraceSample& t) { return t.time; });
  column({"delta", "m", "overlap: displacement of the drive towards the wall"}, [](const TraceSample& t) { return t.delta; });
  column({"force", "N", "normal force, mean over the sample's interval, repulsive positive"}, [](const TraceSample& t) { return t.force; });
  column({"contact_radius", "m", "radius of the contact's edge"}, [](const TraceSample& t) { return t.contact_radius; });
  column({"branch", "1", "0 load, 1 unload, 2 reload"}, [](const TraceSample& t) { return static_cast<double>(t.branch); });
}

void print_summary(const RunSummary& s, const Sphere& sphere)
{
  const double r = sphere.radius;
  fmt::print("coefficient of restitution  {:.4f}\n", s.restitution);
  fmt::print("largest force               {:.5g} N\n", s.force_max);
  fmt::print("largest overlap             {:.5g} m  ({:.4g} R)\n", s.delta_max, s.delta_max / r);
  fmt::print("residual overlap            {:.5g} m  ({:.4g} R)\n", s.delta_residual, s.delta_residual / r);
  fmt::print("contact time                {:.5g} s\n", s.contact_time);
  fmt::print("work of loading, unloading  {:.5g} J, {:.5g} J\n", s.work_load, s.work_unload);
  fmt::print("error estimate              {}\n",
             s.error_estimate > 0 ? fmt::format("{:.2g} % in force and restitution", 100 * s.error_estimate)
                                  : "none (give --tolerance for one)");
  fmt::print("energy balance              closed to {:.1e}\n", s.energy_error);
  fmt::print("{} points, {} steps, {:.2f} s CPU, {:.1f} million point updates/s\n", s.points, s.steps, s.cpu_s,
             s.point_updates_per_s / 1e6);
}

}  // namespace

void add_run_arguments(CLI::App& command, RunArguments& a)
{
  command.add_option("materials", a.materials, "TOML file with [material.NAME] and [particle.NAME]")->required();
  command.add_option("--particle", a.particle, "which [particle.NAME]")->required();
  command.add_option("--grid", a.grid, "reference grid: mapped (tartan and updated are not in this version)")->capture_default_str();
  auto* resolution = command.add_option("--resolution", a.resolution, "cells across the contact zone, 6 to 200 (default: 20 to 40 by depth)");
  command.add_option("--tolerance", a.tolerance, "raise the resolution until force and e are estimated to be this exact (0.01: 1 %)")
      ->excludes(resolution);
  command.add_option("-o,--output", a.output, "write the force history here: .csv or .h5");
  command.add_flag("--json", a.json, "print one JSON object");
}

void run_and_report(const RunArguments& a, const std::string& title,
                    const std::function<RunResult(const Sphere&, const RunOptions&)>& run)
{
  if (a.grid != "mapped") {
    if (a.grid == "tartan" || a.grid == "updated") fail("--grid", fmt::format("this version has no '{}' grid yet", a.grid), {}, "mapped");
    fail("--grid", "unknown grid", a.grid, "mapped");
  }
  if (a.tolerance < 0 || (a.tolerance > 0 && a.tolerance < 1e-4) || a.tolerance > 0.5)
    fail("--tolerance", "cannot be used", fmt::format("{:g}", a.tolerance), "1e-4 to 0.5, relative");
  const std::string ending = std::filesystem::path(a.output).extension().string();
  if (!a.output.empty()) {
    if (ending != ".csv" && ending != ".h5") fail("-o", fmt::format("the ending of '{}' says no format", a.output), {}, ".csv, .h5");
    require_writable(a.output, "-o");
  }
  const MaterialsFile file = read_materials(a.materials);
  const Sphere sphere = sphere_of(file, file.particle(a.particle));

  RunOptions options;
  options.resolution = a.resolution;
  options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  options.estimate_error = a.tolerance > 0;
  RunResult result;
  {
    ProgressBar bar(title);
    options.progress = [&](double fraction) { bar.show(fraction); };
    result = run(sphere, options);
    for (const int finer : {32, 48, 64}) {
      if (a.tolerance <= 0 || result.summary.error_estimate <= a.tolerance) break;
      options.resolution = finer;
      result = run(sphere, options);
    }
  }
  if (!a.output.empty())
    write_atomically(a.output, [&](const std::string& path) { ending == ".csv" ? write_csv(result, path) : write_h5(result, path); });
  if (a.json) fmt::print("{}\n", json_of(result.summary).dump());
  else print_summary(result.summary, sphere);
  if (a.tolerance > 0 && result.summary.error_estimate > a.tolerance)
    fail("--tolerance", "not reached at the finest resolution of this version (64 cells)",
         fmt::format("{:.2g}", result.summary.error_estimate), fmt::format("{:.2g} was asked", a.tolerance));
}

}  // namespace granulaw::tool
