#include "liggghts_plugin/stats_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granulaw::plugin {

std::string start_table(const ContactStatistics& statistics, const DeckUnits& units)
{
  std::string lines;
  for (const auto& [key, counts] : statistics.pairs) {
    const PairInfo info = counts.in_si(units).info;
    if (!info.needed) continue;
    const auto or_none = [](bool known, double value) {
      return known ? fmt::format("{:.4g}", value) : std::string("none");
    };
    lines += fmt::format(
        "  {:<24} {:<18} {:>9} {:>9} {:>9} {:>11} {:>10}  {}; {}\n",
        fmt::format("{} {} - {} {}", key.i, info.a, key.kind == PairKey::particles ? "" : "wall", key.j)
            .append(" ")
            .append(info.b),
        info.rule, or_none(info.stiffness_ratio > 0, info.stiffness_ratio),
        or_none(std::isfinite(info.overlap_limit), info.overlap_limit),
        or_none(info.damage_number_limit > 0, info.damage_number_limit),
        or_none(std::isfinite(info.onset_speed), info.onset_speed), or_none(info.dt_overlap > 0, info.dt_overlap),
        info.law, info.error);
  }
  if (lines.empty()) return lines;
  return fmt::format("granulaw contact laws\n  {:<24} {:<18} {:>9} {:>9} {:>9} {:>11} {:>10}  {}\n{}",
                     "types", "pair rule", "E*/Y", "max d/R*", "max I", "yields m/s", "dt to d/R*",
                     "law; error", lines);
}

std::string end_line(const ContactStatistics& sum, const DeckUnits& units, double damage_number_limit,
                     double largest_dt)
{
  const ContactStatistics::Pair pair = sum.total(false).in_si(units), wall = sum.total(true).in_si(units),
                                all = sum.total().in_si(units);
  std::string line = fmt::format(
      "granulaw: {:.0f} contacts between particles, {:.0f} with walls; impacts up to {:.4g} and {:.4g} m/s; "
      "overlap/R* up to {:.4g} and {:.4g}; normal contacts dissipated {:.6g} J",
      pair.touches, wall.touches, pair.speed_max, wall.speed_max, pair.overlap_max, wall.overlap_max,
      all.dissipated);
  if (all.waves > 0) line += fmt::format(", waves took {:.6g} J", all.waves);
  if (all.near > 0)
    line += fmt::format("; {:.0f} contacts came deeper than {:.0f} % of the law's table, {:.0f} beyond it",
                        all.near, 100 * near_edge, all.past);
  if (all.beyond > 0) line += fmt::format("; {:.0f} contact-steps beyond the law's table", all.beyond);
  if (all.too_fast > 0)
    line += fmt::format("; {:.0f} contacts began faster than the law's velocity axis goes", all.too_fast);
  if (all.too_slow > 0)
    line += fmt::format(
        "; {:.0f} contacts began slower than the slowest impact that the rate-dependent law knows and "
        "follow it as at that rate",
        all.too_slow);
  if (all.sudden > 0)
    line += fmt::format(
        "; {:.0f} contacts began deeper than the motion of a step can bring them (particles inserted into "
        "each other, "
        "edges of a mesh): they brought {:.6g} J, and none of it is in what was dissipated",
        all.sudden, all.brought);
  if (damage_number_limit > 0 && all.damage_number_max > damage_number_limit)
    line += fmt::format(
        "; impacts up to I = rho V^2/Y = {:.3g}, the law holds to {:.3g}: above that it overstates "
        "restitution",
        all.damage_number_max, damage_number_limit);
  if (all.frequency2 > 0)
    line += fmt::format("; the stiffest contact allowed a time step of {:.4g} s, used were {:.4g} s",
                        all.dt_allowed(), largest_dt);
  return line + "\n";
}

}  // namespace granulaw::plugin
