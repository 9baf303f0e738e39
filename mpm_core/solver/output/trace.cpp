#include "solver/output/trace.hpp"

namespace granulaw {

namespace {

/// Calls change(number, its unit) for every number of a run that has a dimension.
template <class Change>
void change_units(RunResult& run, Change change)
{
  const auto change_all = [&](auto& of, const auto& units) {
    auto numbers = numbers_of(of);
    static_assert(std::tuple_size_v<decltype(numbers)> == std::tuple_size_v<std::decay_t<decltype(units)>>);
    for (std::size_t k = 0; k < numbers.size(); ++k) change(numbers[k], units[k]);
    of = std::bit_cast<std::decay_t<decltype(of)>>(numbers);
  };
  for (TraceSample& t : run.trace)
    for (const auto& [value, unit] : trace_numbers) change(t.*value, unit);
  for (double& overlap : run.yield_overlaps) change(overlap, Unit::length);
  for (const SummaryNumber& n : summary_numbers) change(run.summary.*n.value, n.unit);
  for (PlaneTrace& plane : run.planes)
    for (PlaneSample& sample : plane.samples) change_all(sample, plane_units);
  if (run.rebound) change_all(*run.rebound, rebound_units);
}

}  // namespace

double size_of(Unit unit, const Scales& scales)
{
  const double sizes[] = {1,
                          scales.length,
                          scales.time(),
                          scales.force(),
                          scales.energy(),
                          1 / scales.time(),
                          scales.force() * scales.time()};
  return sizes[static_cast<int>(unit)];
}

RunResult in_si(RunResult run, const Scales& scale)
{
  change_units(run, [&](double& number, Unit unit) { number *= size_of(unit, scale); });
  return run;
}

RunResult dimensionless(RunResult run, const Scales& scale)
{
  change_units(run, [&](double& number, Unit unit) { number /= size_of(unit, scale); });
  return run;
}

}  // namespace granulaw
