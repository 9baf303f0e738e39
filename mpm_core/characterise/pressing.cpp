#include "characterise/pressing.hpp"

#include <algorithm>
#include <cmath>
#include <span>

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

/// int_0^1 du/sqrt(1 - u^(n+1)): duration of an unloading u^n over (x_m - r)/(speed of rebound).
double duration_factor(double n)
{
  const double a = 1 / (n + 1);
  return a * std::tgamma(a) * std::sqrt(M_PI) / std::tgamma(a + 0.5);
}

}  // namespace

double residual_as_long(const std::vector<PathPoint>& path, double turn_force)
{
  const double end = path.back().x, span = path.front().x - end;
  // v^2 is as the work given back so far: int dx/sqrt(W), exact over an interval of constant force
  double work = 0, duration = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double step = path[k - 1].x - path[k].x, before = work;
    work += 0.5 * (path[k - 1].force + path[k].force) * step;
    if (work > 0) duration += 2 * step / (std::sqrt(before) + std::sqrt(work));
  }
  // n > 0: an r nearer to the turn could not give the work back
  const double shortest = work / turn_force;
  if (!(work > 0 && span > 1.05 * shortest)) return end;
  const auto told = [&](double s) {
    return s / std::sqrt(work) * duration_factor(turn_force * s / work - 1);
  };
  // the longer the span, the longer it takes; a fifth: no unloading of a sphere is further from u^n
  double low = std::max(0.8 * span, 1.02 * shortest), high = 1.2 * span;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (told(middle) < duration ? low : high) = middle;
  }
  return path.front().x - low;
}

namespace {

/// Pressing::residual of an unloading from `depth` whose force ended at the overlap `touched`.
double residual_of(std::span<const TraceSample> unloading, double depth, double turn_force, double touched)
{
  if (turn_force <= 0) return std::max(0.0, touched);
  std::vector<PathPoint> path{{depth, turn_force}};
  for (const TraceSample& s : unloading)
    if (s.delta < path.back().x && s.delta > touched) path.push_back({s.delta, s.force / force_scale});
  path.push_back({touched, 0});
  return std::max(0.0, residual_as_long(path, turn_force));
}

}  // namespace

Pressing pressing_from(const RunResult& result)
{
  Pressing press;
  press.depth = result.summary.delta_max;
  press.work_ratio = result.summary.work_unload / result.summary.work_load;
  const auto& t = result.trace;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k].branch != Branch::load) continue;
    if (t[k].delta > (press.loading.empty() ? 0.0 : press.loading.back().x))
      press.loading.push_back({t[k].delta, t[k].force / force_scale, t[k].contact_radius});
    if (k + 1 < t.size() && t[k + 1].branch == Branch::unload) press.turn_force = force_before(t, k);
  }
  const auto begins = std::find_if(t.rbegin(), t.rend(), [](const TraceSample& sample) {
                        return sample.branch != Branch::unload;
                      }).base();
  press.residual =
      residual_of({begins, t.end()}, press.depth, press.turn_force, result.summary.delta_residual);
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
  std::size_t begins = 0;
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
      if (t[k - 1].branch != Branch::unload) {
        turns.push_back({{}, t[k - 1].delta, t[k - 1].delta, 0, force_before(t, k - 1)});
        begins = k;
      }
      Pressing& turn = turns.back();
      turn.work_ratio -= piece / put_in;
      if (t[k].force > 0) turn.residual = t[k].delta;
      if (k + 1 < t.size() && t[k + 1].branch != Branch::unload)
        turn.residual = residual_of(std::span(t).subspan(begins, k + 1 - begins), turn.depth, turn.turn_force,
                                    turn.residual);
    }
  }
  if (!turns.empty()) turns.pop_back();  // its summary tells the last one better
  return turns;
}

}  // namespace granulaw
