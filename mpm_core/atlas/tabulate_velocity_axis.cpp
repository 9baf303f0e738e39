#include "atlas/tabulate_velocity_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "atlas/impact_level.hpp"
#include "atlas/impacts_by_speed.hpp"
#include "atlas/node_slopes.hpp"
#include "atlas/overlap_at_work.hpp"

namespace granulaw {

namespace {

constexpr double speed_spacing = 0.02;    // of the nodes of X(v)
constexpr double level_spacing = 0.0125;  // of X, about, beyond the first
constexpr double levels_an_octave = 3;    // of a rate axis
constexpr int first_levels = 3;           // within the first spacing: what inertia changes is there soon
constexpr double first_resolved = 1.5;    // X of the first level over the onset: what speed changes nearer to
                                          // it is less than the scatter of such impacts
constexpr double usual_share_end = 1.5;   // x/X where the force is the press's again

/// X(v) at equal steps.
void tabulate_reach(AxisTable& table, const ImpactsBySpeed& impacts, int steps)
{
  const double spacing = table.speed_end / steps;
  std::vector<double> speeds;
  for (int k = 0; k <= steps; ++k) {
    speeds.push_back(spacing * k);
    table.reach.value.push_back(impacts.impact_overlap(speeds.back()));
  }
  table.reach.slope = difference_slopes(table.reach.value, spacing);
  make_rise(table.reach, speeds);
}

/// Even in X, but for those that divide the first spacing. Of a soft body none lies below the first that its
/// slow impacts resolve.
void place_levels_from_standstill(AxisTable& table, double onset)
{
  const double end = table.reach.value.back(), least = first_resolved * onset;
  double spacings = std::round(end / level_spacing);
  if (end / spacings < least) spacings = std::floor(end / least);
  spacings = std::max(2.0, spacings);
  const double spacing = end / spacings;
  const int within_first = spacing < first_levels * least ? 1 : first_levels;
  for (int k = 1; k < within_first; ++k) table.level.push_back(spacing * k / within_first);
  for (int k = 1; k < static_cast<int>(spacings); ++k) table.level.push_back(spacing * k);
  table.level.push_back(end);
}

/// Even in ln X, from that of the slowest impact on.
void place_levels_by_octaves(AxisTable& table, double first)
{
  const double end = table.reach.value.back(), range = std::log2(end / first);
  const int gaps = std::max(1, static_cast<int>(std::round(levels_an_octave * range)));
  for (int k = 0; k < gaps; ++k) table.level.push_back(first * std::exp2(range * k / gaps));
  table.level.push_back(end);
}

/// `fastest`, or less where an impact would reverse beyond the table; throws where none was as fast.
double end_of_axis(const LawShape& shape, const Curve& slow, const ImpactsBySpeed& impacts, double fastest)
{
  const double last = shape.velocity_effects.empty() ? 0 : shape.velocity_effects.back().speed;
  if (!(fastest > 0 && fastest <= last * 1.0001))
    fail("fit", "no impact was as fast", fmt::format("sqrt(I) = {:.4g}", fastest),
         fmt::format("up to {:.4g}", last));
  while (impacts.impact_overlap(fastest) > slow.end())
    fastest *= std::min(0.98, std::sqrt(slow.end() / impacts.impact_overlap(fastest)));
  return fastest;
}

/// Impacts to the levels' overlaps, and what they lose: the press's loss at X and what speed adds.
std::vector<LawShape::VelocityEffect> tabulate_losses(AxisTable& table, const ImpactsBySpeed& impacts,
                                                      const Curve& slow)
{
  std::vector<LawShape::VelocityEffect> effects;
  for (const double latched : table.level) {
    effects.push_back(impacts.effect(impacts.speed(latched, table.speed_begin, table.speed_end)));
    double kept = 1, span = 1;
    if (const double x = std::min(latched, slow.end()); x > slow.onset()) {
      const Curve::Top press = slow.top(x);
      kept = std::min(1.0, press.kept * std::exp(-effects.back().dissipation));
      span = std::min(1.0, press.span * std::exp(-effects.back().residual));
    }
    table.kept.push_back(kept), table.span.push_back(span);
  }
  return effects;
}

void append(const HermiteColumn& level, HermiteColumn& all)
{
  all.value.insert(all.value.end(), level.value.begin(), level.value.end());
  all.slope.insert(all.slope.end(), level.slope.begin(), level.slope.end());
}

/// Forces of all levels; empty where one is not the press's at the end.
HermiteColumn rate_forces(const AxisTable& table, const std::vector<LawShape::VelocityEffect>& effects,
                   const Curve& slow)
{
  HermiteColumn forces;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const std::vector<double> beside{table.level[k ? k - 1 : 0],
                                     table.level[std::min(k + 1, effects.size() - 1)]};
    const HermiteColumn force = rate_force(effects[k], table.level[k], slow, beside, table.share_end);
    if (force.value.empty()) return {};
    append(force, forces);
  }
  return forces;
}

}  // namespace

AxisTable tabulate_inertia(const LawShape& shape, const Curve& slow, double e_star_over_yield, double mass,
                           double fastest)
{
  const ImpactsBySpeed impacts(shape, slow, energy_unit(mass, 1 / e_star_over_yield), AxisTable::By::inertia);
  AxisTable table;
  table.speed_end = end_of_axis(shape, slow, impacts, fastest);
  table.share_end = usual_share_end;
  tabulate_reach(table, impacts,
                 std::max(3, static_cast<int>(std::ceil(table.speed_end / speed_spacing - 1e-9))));
  place_levels_from_standstill(table, slow.onset());
  for (const LawShape::VelocityEffect& effect : tabulate_losses(table, impacts, slow))
    append(inertia_force(effect, table.share_end), table.force);
  return table;
}

AxisTable tabulate_rate(const LawShape& shape, const Curve& slow, double e_star_over_yield, double mass,
                        double fastest, double reference_radius)
{
  const ImpactsBySpeed impacts(shape, slow, energy_unit(mass, 1 / e_star_over_yield), AxisTable::By::rate);
  AxisTable table;
  table.by = AxisTable::By::rate;
  table.reference_radius = reference_radius;
  table.speed_end = end_of_axis(shape, slow, impacts, fastest);
  table.speed_begin = shape.velocity_effects.front().speed;
  if (!(table.speed_begin < 0.7 * table.speed_end))
    fail("fit", "the slowest and the fastest impact of a rate-dependent law are too near to each other",
         fmt::format("sqrt(I) = {:.4g} and {:.4g}", table.speed_begin, table.speed_end), "1.5 times or more");
  // X(v) is as v^0.8 to v: an eighth of the first speed a step, and one table for all
  const double steps = std::clamp(8 * table.speed_end / table.speed_begin, 16.0, 2048.0);
  tabulate_reach(table, impacts, static_cast<int>(steps));
  place_levels_by_octaves(table, impacts.impact_overlap(table.speed_begin));
  const std::vector<LawShape::VelocityEffect> effects = tabulate_losses(table, impacts, slow);
  // further out, where a force that keeps its peak is not yet the press's
  constexpr double farthest = 12;
  table.share_end = usual_share_end;
  while ((table.force = rate_forces(table, effects, slow)).value.empty()) {
    table.share_end = share_spacing * std::ceil(1.2 * table.share_end / share_spacing);
    if (table.share_end > farthest)
      fail("fit", "a rate raises the force so much that it is the press's again only far beyond the impacts",
           fmt::format("over {:g} of their overlap", farthest));
  }
  return table;
}

}  // namespace granulaw
