// Error against CPU seconds for every grid and precision: the numbers behind docs/cost.md and its picture.
//
//   cost_study OUT.csv [QUICK]
//
// Two jobs, one core: the plastic impact E*/Y = 100, V/V_y = 100, and the elastic impact that Hertz would
// stop at 0.002 R. Reference: the mapped grid at 56 cells, 8 shifted grids, Courant number 0.5; the first two
// lines hold the same at 40 cells: how good the reference is. Columns: job, grid, precision, cells, grids
// (shifted), points, CPU seconds, million point updates a second, L2 deviation of the treated loading force
// over 0.05 to 1 delta_max, deviation of F_max and of e, raw ripple (rms of F/fit - 1 over 0.25 to 1
// delta_max), energy error.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "../verification/references.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/scales.hpp"
#include "solver/ripple.hpp"
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

std::string line(const std::string& job, const RunOptions& o, const RunResult& r, const RunResult& reference)
{
  const RunSummary& s = r.summary;
  const std::string text = fmt::format(
      "{},{},{},{},{},{},{:.4g},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{:.2g}\n", job, name_of(o.grid),
      o.precision == Precision::single ? "single" : "double", o.resolution, o.phases, s.points, s.cpu_s,
      s.point_updates_per_s / 1e6, distance(r, reference), s.force_max / reference.summary.force_max - 1,
      s.restitution / reference.summary.restitution - 1, s.ripple, s.energy_error);
  fmt::print("{}", text);
  std::fflush(stdout);
  return text;
}

std::string study(const std::string& job, const Sphere& sphere, double velocity, bool quick)
{
  RunOptions o;
  o.grid = GridKind::mapped, o.precision = Precision::full;
  o.resolution = quick ? 28 : 56, o.phases = 8, o.courant = 0.5;
  const RunResult reference = run_impact(sphere, velocity, o);
  o.resolution = quick ? 20 : 40;
  std::string text = line(job, o, run_impact(sphere, velocity, o), reference);
  o = {};
  for (const GridKind grid : {GridKind::mapped, GridKind::tartan, GridKind::updated})
    for (const Precision precision : {Precision::full, Precision::single}) {
      if (grid == GridKind::updated && precision == Precision::single) continue;
      for (const int phases : {1, 4})
        for (const int cells : {8, 12, 16, 24, 32}) {
          if (cells > (quick ? 12 : grid == GridKind::updated ? 24 : 32)) continue;
          if (phases == 1 && grid != GridKind::mapped) continue;
          o.grid = grid, o.precision = precision, o.resolution = cells, o.phases = phases;
          text += line(job, o, run_impact(sphere, velocity, o), reference);
        }
    }
  return text;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 2) {
    fmt::print(stderr, "cost_study OUT.csv [quick]\n");
    return 2;
  }
  try {
    const bool quick = argc > 2;
    std::string text =
        "job,grid,precision,cells,grids,points,cpu_s,Mupd_s,L2_force,err_force,err_e,ripple,energy\n";
    text += study("plastic", reference::unit_sphere(100), 100 * yield_velocity(1, 0.01, 1), quick);
    text += study("elastic", reference::unit_sphere(0), reference::elastic_impact_velocity(), quick);
    write_atomically(argv[1], [&](const std::string& path) { std::ofstream(path) << text; });
  } catch (const Error& error) {
    fmt::print(stderr, "cost_study: {}\n", error.what());
    return 2;
  }
}
