#include "characterise/pressing.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

constexpr double force_scale = 4.0 / 3.0;  // Hertz's force at x = 1

/// Mean force of the loading samples within 1 % below the turn at trace[turn].
double force_before(const std::vector<TraceSample>& trace, std::size_t turn)
{
  double sum = 0;
  int count = 0;
  for (std::size_t k = turn + 1; k-- > 0 && trace[k].delta >= 0.99 * trace[turn].delta;) {
    if (trace[k].branch != Branch::load) break;
    // the law rises by about F ~ x there: brought to the turn
    sum += trace[k].force * trace[turn].delta / trace[k].delta;
    ++count;
  }
  return count ? sum / count / force_scale : 0;
}

}  // namespace

Pressing pressing_from(const RunResult& result)
{
  Pressing press;
  press.depth = result.summary.delta_max;
  press.residual = std::max(0.0, result.summary.delta_residual);
  press.work_ratio = result.summary.work_unload / result.summary.work_load;
  const auto& t = result.trace;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k].branch != Branch::load) continue;
    if (t[k].delta > (press.loading.empty() ? 0.0 : press.loading.back().x))
      press.loading.push_back({t[k].delta, t[k].force / force_scale, t[k].contact_radius});
    if (k + 1 < t.size() && t[k + 1].branch == Branch::unload) press.turn_force = force_before(t, k);
  }
  return press;
}

double force_at_turn(const std::vector<TraceSample>& trace)
{
  double depth = 0, sum = 0;
  int count = 0;
  for (const TraceSample& t : trace)
    if (t.branch == Branch::load) depth = std::max(depth, t.delta);
  for (const TraceSample& t : trace)
    if (t.branch == Branch::load && t.delta >= 0.995 * depth) sum += t.force, ++count;
  return count ? sum / count : 0;
}

std::vector<Pressing> partial_unloadings(const RunResult& result, double& loop)
{
  std::vector<Pressing> turns;
  const auto& t = result.trace;
  double put_in = 0, area = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double piece = 0.5 * (t[k].force + t[k - 1].force) * (t[k].delta - t[k - 1].delta);
    if (t[k].branch == Branch::load) {
      if (t[k - 1].branch == Branch::reload && put_in > 0) loop = std::max(loop, std::abs(area) / put_in);
      put_in += piece;
      area = 0;
      continue;
    }
    area += piece;
    if (t[k].branch == Branch::unload) {
      if (t[k - 1].branch != Branch::unload)
        turns.push_back({{}, t[k - 1].delta, t[k - 1].delta, 0, force_before(t, k - 1)});
      Pressing& turn = turns.back();
      turn.work_ratio -= piece / put_in;
      if (t[k].force > 0) turn.residual = t[k].delta;
    }
  }
  if (!turns.empty()) turns.pop_back();  // its summary tells the last one better
  return turns;
}

}  // namespace granulaw
