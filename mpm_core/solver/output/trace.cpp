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
