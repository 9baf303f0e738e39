// Speed and error of the solver on one line, by resolution (cells across the contact block).
//
//   solver_benchmark                                   all jobs
//   solver_benchmark --benchmark_filter=Impact_EY100   one of them
//
// Counters: cpu_s  CPU seconds of one run (all shifted grids), Mupd_s  million point updates a second on one
// core, err_F_pct and err_e_pct  deviation of the treated largest force and of e from the reference in
// percent. References (tests/verification/references.hpp): plastic impact: this solver at 56 (F) and 40 (e)
// cells and 8 grids, which 32 cells and 4 grids change by 0.03 %; elastic impact: three formulations' common
// result, good to 0.2 %; press: finite elements, 0.4 %.
#include <benchmark/benchmark.h>

#include "../verification/references.hpp"
#include "base/scales.hpp"
#include "solver/runs.hpp"

namespace {

using namespace granulaw;

void report(benchmark::State& state, const RunSummary& s, double force, double restitution, double force_unit)
{
  state.counters["cpu_s"] = s.cpu_s;
  state.counters["points"] = static_cast<double>(s.points);
  state.counters["Mupd_s"] = s.point_updates_per_s / 1e6;
  state.counters["err_F_pct"] = 100 * (s.force_max / force_unit / force - 1);
  state.counters["err_e_pct"] = 100 * (s.restitution / restitution - 1);
  state.counters["ripple_pct"] = 100 * s.grid_noise;
}

RunOptions options(const benchmark::State& state)
{
  RunOptions o;
  o.resolution = static_cast<int>(state.range(0));
  o.shifted_grids = static_cast<int>(state.range(1));
  return o;
}

void Impact_EY100_V100(benchmark::State& state)
{
  const Particle sphere = reference::unit_sphere(100);
  const double v = 100 * yield_velocity(1.0, 0.01, 1.0);
  RunResult r;
  for (auto _ : state) r = impact(sphere, {v}, {}, options(state));
  report(state, r.summary, reference::impact_EY100_V100_force, reference::impact_EY100_V100_e, 0.01);
}

void Impact_elastic(benchmark::State& state)
{
  const Particle sphere = reference::unit_sphere(0);
  RunResult r;
  for (auto _ : state) r = impact(sphere, {reference::elastic_impact_velocity()}, {}, options(state));
  report(state, r.summary, reference::elastic_impact_force, 1.0, 1.0);
}

void Press_EY100_depth002(benchmark::State& state)
{
  const Particle sphere = reference::unit_sphere(100);
  PressPlan plan;
  plan.depth = 0.02;
  plan.support = Support::midplane;
  RunResult r;
  for (auto _ : state) r = press(sphere, plan, {}, options(state));
  const reference::Press& p = reference::presses[0];
  report(state, r.summary, p.force, p.e, 0.01);
}

}  // namespace

BENCHMARK(Impact_EY100_V100)
    ->ArgsProduct({{12, 16, 24, 32}, {1, 4}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK(Impact_elastic)->ArgsProduct({{12, 16, 24}, {1, 4}})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(Press_EY100_depth002)
    ->ArgsProduct({{12, 16, 24}, {1, 4}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
