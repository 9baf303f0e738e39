// Error against CPU seconds for every grid and precision: the numbers behind docs/evidence/cost.md and its
// picture.
//
//   cost_study OUT.json
//
// Written job by job; the same build, called again, keeps the jobs that are there.
//
// Three dimensions take part in the plastic impact: in the elastic one a run takes minutes.
//
// Two jobs, one core: the plastic impact E*/Y = 100, V/V_y = 100, and the elastic impact that Hertz would
// stop at 0.002 R. Reference: the mapped grid at 56 cells, 8 shifted grids, Courant number 0.5; "reference"
// holds the same at 40 cells: how good the reference is. Of each run, in the file: job, grid, precision,
// cells, grids (shifted), points, cpu_s, Mupd_s: million point updates a second, L2_force: L2 deviation of
// the treated loading force over 0.05 to 1 delta_max, err_force and err_e: deviation of F_max and of e,
// grid noise: rms of F/fit - 1 over 0.25 to 1 delta_max, energy: energy error. Deviations and errors:
// relative.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "../verification/references.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/scales.hpp"
#include "base/version.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/runs.hpp"

namespace {

using namespace granulaw;

/// L2 norm of the difference of the treated loading forces over that of the reference, 0.05 to 1 delta_max.
double distance(const RunResult& found, const RunResult& reference)
{
  const TreatedLoading a(found.trace, 0.05), b(reference.trace, 0.05);
  const double deepest = std::min(found.summary.delta_max, reference.summary.delta_max);
  double difference = 0, norm = 0;
  for (int k = 0; k <= 200; ++k) {
    const double delta = deepest * (0.05 + 0.95 * k / 200);
    const double f = b.force(delta);
    difference += (a.force(delta) - f) * (a.force(delta) - f), norm += f * f;
  }
  return std::sqrt(difference / norm);
}

using nlohmann::json;

/// Six digits: more would be noise.
double rounded(double value)
{
  return std::stod(fmt::format("{:.6g}", value));
}

json row(const std::string& job, const RunOptions& o, const RunResult& r, const RunResult& reference)
{
  const RunSummary& s = r.summary;
  const json found = {
      {"job", job},
      {"grid", name_of(o.grid)},
      {"precision", o.precision == Precision::single ? "single" : "double"},
      {"cells", o.resolution},
      {"grids", o.shifted_grids},
      {"points", s.points},
      {"cpu_s", rounded(s.cpu_s)},
      {"Mupd_s", rounded(s.point_updates_per_s / 1e6)},
      {"L2_force", rounded(distance(r, reference))},
      {"err_force", rounded(s.force_max / reference.summary.force_max - 1)},
      {"err_e", rounded(s.restitution / reference.summary.restitution - 1)},
      {"ripple", rounded(s.grid_noise)},
      {"energy", rounded(s.energy_error)},
  };
  fmt::print("{}\n", found.dump());
  std::fflush(stdout);
  return found;
}

/// The rows of three dimensions; `rows` is added to.
void study_spatial(const std::string& job, const Particle& sphere, double velocity,
                   const RunResult& reference, json& rows)
{
  RunOptions o;
  o.grid = GridKind::spatial;
  for (const int shifted_grids : {1, 4})
    for (const int cells : {6, 8, 11, 16}) {
      o.resolution = cells, o.shifted_grids = shifted_grids;
      rows.push_back(row(job, o, impact(sphere, {velocity}, {}, o), reference));
    }
}

json study(const std::string& job, const Particle& sphere, double velocity)
{
  RunOptions o;
  o.grid = GridKind::mapped, o.precision = Precision::full;
  o.resolution = 56, o.shifted_grids = 8, o.courant = 0.5;
  const RunResult reference = impact(sphere, {velocity}, {}, o);
  json found = {{"name", job}, {"reference_cells", o.resolution}, {"rows", json::array()}};
  o.resolution = 40;
  found["reference"] = row(job, o, impact(sphere, {velocity}, {}, o), reference);
  o = {};
  for (const GridKind grid : {GridKind::mapped, GridKind::rectilinear, GridKind::updated})
    for (const Precision precision : {Precision::full, Precision::single}) {
      if (grid == GridKind::updated && precision == Precision::single) continue;
      for (const int shifted_grids : {1, 4})
        for (const int cells : {8, 12, 16, 24, 32}) {
          if (cells > (grid == GridKind::updated ? 24 : 32)) continue;
          if (shifted_grids == 1 && grid != GridKind::mapped) continue;
          o.grid = grid, o.precision = precision, o.resolution = cells, o.shifted_grids = shifted_grids;
          found["rows"].push_back(row(job, o, impact(sphere, {velocity}, {}, o), reference));
        }
    }
  if (job == "plastic") study_spatial(job, sphere, velocity, reference, found["rows"]);
  return found;
}

std::string processor()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.find(": ") + 2, line.size()));
  return "unknown";
}

std::string utc_now()
{
  char text[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

/// The jobs that a study of this very build finished before it was stopped; none if there is no such file.
json jobs_kept(const char* path, const json& now)
{
  std::ifstream file(path);
  const json old = json::parse(file, nullptr, false);
  if (!old.is_object() || !old.contains("jobs")) return json::array();
  for (const char* key : {"study", "granulaw_version", "git_hash", "processor"})
    if (!old.contains(key) || old[key] != now[key]) return json::array();
  return old["jobs"];
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    fmt::print(stderr, "cost_study OUT.json\n");
    return 2;
  }
  try {
    json found = {{"study", "cost"},      {"granulaw_version", version()}, {"git_hash", git_hash()},
                  {"created", utc_now()}, {"processor", processor()},      {"jobs", json::array()}};
    const json kept = jobs_kept(argv[1], found);
    const auto finish = [&](const std::string& name, const Particle& sphere, double velocity) {
      const auto old =
          std::find_if(kept.begin(), kept.end(), [&](const json& j) { return j["name"] == name; });
      found["jobs"].push_back(old != kept.end() ? *old : study(name, sphere, velocity));
      write_atomically(argv[1],
                       [&](const std::string& path) { std::ofstream(path) << found.dump(1) << "\n"; });
    };
    finish("plastic", reference::unit_sphere(100), 100 * yield_velocity(1, 0.01, 1));
    finish("elastic", reference::unit_sphere(0), reference::elastic_impact_velocity());
  } catch (const Error& error) {
    fmt::print(stderr, "cost_study: {}\n", error.what());
    return 2;
  }
}
