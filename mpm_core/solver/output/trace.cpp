#include "solver/output/trace.hpp"

namespace granulaw {

namespace {

/// Calls change(number, its unit) for every number of a run that has a dimension.
template <class Change>
void change_units(RunResult& run, const Scales& unit, Change change)
{
  for (TraceSample& t : run.trace) {
    change(t.time, unit.time());
    change(t.delta, unit.length);
    change(t.force, unit.force());
    change(t.contact_radius, unit.length);
  }
  for (double& overlap : run.yield_overlaps) change(overlap, unit.length);
  RunSummary& s = run.summary;
  change(s.force_max, unit.force());
  change(s.delta_max, unit.length);
  change(s.delta_residual, unit.length);
  change(s.contact_time, unit.time());
  change(s.work_load, unit.energy());
  change(s.work_unload, unit.energy());
  for (PlaneTrace& plane : run.planes)
    for (PlaneSample& p : plane.samples) {
      change(p.delta, unit.length), change(p.force, unit.force());
      for (int d = 0; d < 3; ++d) {
        change(p.vector[d], unit.force()), change(p.torque[d], unit.energy());
        change(p.centre[d], unit.length);
      }
      for (double& axis : p.axes) change(axis, unit.length);
    }
  if (!run.rebound) return;
  for (double& w : run.rebound->spin) change(w, 1 / unit.time());
  for (double* impulse : {&run.rebound->impulse_normal, &run.rebound->impulse_tangential})
    change(*impulse, unit.force() * unit.time());
}

}  // namespace

RunResult in_si(RunResult run, const Scales& scale)
{
  change_units(run, scale, [](double& number, double unit) { number *= unit; });
  return run;
}

RunResult dimensionless(RunResult run, const Scales& scale)
{
  change_units(run, scale, [](double& number, double unit) { number /= unit; });
  return run;
}

}  // namespace granulaw
