#include "calibrate/cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/fit.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

/// The partial unloadings of a curve that has a last one, too.
std::vector<Unloading> cycles_of(const Measurement& m)
{
  if (!m.kind->has_machine) return {};
  std::vector<Unloading> all = m.unloadings();
  if (all.empty() || all.back().last < m.data.size()) return {};
  all.pop_back();
  return all;
}

void remove(Measurement& m, const Unloading& u)
{
  const auto begin = m.data.begin();
  m.data.erase(begin + static_cast<std::ptrdiff_t>(u.first), begin + static_cast<std::ptrdiff_t>(u.last));
}

/// Sentence on a partial unloading that a fit to the rest of its curve contradicts; empty: it does not.
std::string contradiction(const Measurement& m, const std::vector<Unloading>& cycles, std::size_t cycle,
                          const Trial& rest)
{
  constexpr double clear = 4;  // standard deviations
  constexpr double allowed =
      0.25;  // of the fall: a curve gives the stiffness to 10 %, and recovery takes time
  const Unloading& u = cycles[cycle];
  const auto fall = [&](double beyond) {
    Trial trial = rest;
    trial.machine.beyond.assign(cycles.size() + 1, 0.0);
    trial.machine.beyond[cycle] = beyond;
    return m.kind->predict(m, trial).values;
  };
  std::size_t top = u.first - 1, low = u.first;
  if (m.data[u.first].x > m.data[top].x) top = u.first;
  for (std::size_t k = u.first; k < u.last; ++k)
    if (m.data[k].x < m.data[low].x) low = k;
  const std::vector<double> near = fall(0), far = fall(u.gap);
  const double least = near[u.first - 1] - near[low], most = far[u.first - 1] - far[low],
               measured = m.data[u.first - 1].y - m.data[low].y,
               noise = clear * std::hypot(m.data[u.first - 1].sd, m.data[low].sd);
  if (measured > (1 - allowed) * std::min(least, most) - noise &&
      measured < (1 + allowed) * std::max(least, most) + noise)
    return {};
  return fmt::format(
      "the partial unloading from {:.4g} m (line {}) falls by {:.3g} N to {:.4g} m, that of a material of "
      "the rest of the curve by "
      "{:.3g} N: it is not used; a machine that gives way, recovery that takes time, or displacements that "
      "were corrected",
      m.data[top].x, m.data[top].line, measured, m.data[low].x, least);
}

}  // namespace

void set_cycles_aside(const Atlas& atlas, CalibrationRequest& request)
{
  CalibrationRequest rest = request;
  bool any = false;
  for (Measurement& m : rest.measurements) {
    const std::vector<Unloading> cycles = cycles_of(m);
    any = any || !cycles.empty();
    std::for_each(cycles.rbegin(), cycles.rend(), [&](const Unloading& u) { remove(m, u); });
  }
  if (!any) return;
  const CalibrationProblem problem(atlas, rest);
  const Coordinates q = best_fit(problem).q;
  const CandidateMaterial material = problem.material(q);
  for (std::size_t k = 0; k < request.measurements.size(); ++k) {
    Measurement& m = request.measurements[k];
    const Measurement all = m;
    const std::vector<Unloading> cycles = cycles_of(all);
    for (std::size_t c = cycles.size(); c-- > 0;) {
      const std::string why =
          contradiction(all, cycles, c,
                        {material, *problem.laws().of(material), problem.machine(q, k), problem.composed(k)});
      if (why.empty()) continue;
      remove(m, cycles[c]);
      m.set_aside.insert(m.set_aside.begin(), why);
    }
  }
}

}  // namespace granulaw
