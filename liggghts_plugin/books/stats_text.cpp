#include "liggghts_plugin/books/stats_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granulaw::plugin {

namespace {

std::string types_text(const PairKey& key)
{
  return fmt::format("{} - {}{}", key.i, key.kind == PairKey::particles ? "" : "wall ", key.j);
}

std::string error_text(const PairInfo& info)
{
  if (!info.note.empty()) return info.note;
  std::string text = info.stated.bound.text();
  if (info.stated.covered < 1)
    text += fmt::format(" on {:.0f} % of the orientations", 100 * info.stated.covered);
  return text;
}

std::string number_or_none(bool known, double value)
{
  return known ? fmt::format("{:.4g}", value) : std::string("none");
}

/// A row of the table at the end: between particles, with walls.
std::string row(const char* quantity, const std::string& particles, const std::string& walls)
{
  return fmt::format("  {:<42} {:>14} {:>14}\n", quantity, particles, walls);
}

std::string row(const char* quantity, const char* format, double particles, double walls)
{
  return row(quantity, fmt::format(fmt::runtime(format), particles),
             fmt::format(fmt::runtime(format), walls));
}

/// Contacts that left what their law covers, a line for each kind.
std::string limits_text(const ContactStatistics& sum, const ContactStatistics::Pair& all,
                        const DeepContacts& deep)
{
  std::string lines;
  const auto add = [&](const std::string& line) { lines += "  " + line + "\n"; };
  if (all.near > 0)
    add(fmt::format("{:.0f} contacts came deeper than {:.0f} % of the law's table, {:.0f} beyond it",
                    all.near, 100 * near_edge, all.past));
  if (all.beyond > 0) add(fmt::format("{:.0f} contact-steps beyond the law's table", all.beyond));
  if (all.crushed > 0)
    add(fmt::format("contacts crushed beyond the law's table took {:.6g} J (beyondRange crush): an estimate, which no law states", all.crushed));
  if (deep.contacts > 0)
    add(fmt::format(
        "{:.0f} contacts flattened a body by more than a tenth of its radius; {:.0f} particles had several "
        "of them at once: no law of one contact holds there, and no error bound; model mpm has 'confinement auto' for pressed beds (mpm plan)",
        deep.contacts, deep.particles));
  if (all.too_fast > 0)
    add(fmt::format("{:.0f} contacts began faster than the law's velocity axis goes", all.too_fast));
  if (all.too_slow > 0)
    add(fmt::format(
        "{:.0f} contacts began slower than the lowest speed of the rate-dependent law, and follow the law "
        "of that speed",
        all.too_slow));
  if (all.sudden > 0)
    add(fmt::format(
        "{:.0f} contacts began deeper than the motion of a step can bring them (particles inserted into "
        "each other, edges of a mesh): they brought {:.6g} J, and none of it is in what was dissipated",
        all.sudden, all.brought));
  for (const auto& [key, counts] : sum.pairs) {
    const double limit = counts.info.damage_number_limit;
    if (limit > 0 && counts.damage_number_max > limit)
      add(fmt::format(
          "types {}: impacts up to I = rho V^2/Y = {:.3g}; the error bound of the law holds to {:.3g}",
          types_text(key), counts.damage_number_max, limit));
  }
  return lines;
}

}  // namespace

std::string start_table(const ContactStatistics& statistics, const DeckUnits& units)
{
  std::string lines;
  for (const auto& [key, counts] : statistics.pairs) {
    const PairInfo info = counts.in_si(units).info;
    if (!info.needed) continue;
    lines += fmt::format(
        "  {:<24} {:<18} {:>9} {:>9} {:>9} {:>11} {:>10}  {}; {}\n",
        fmt::format("{} {} - {} {}", key.i, info.a, key.kind == PairKey::particles ? "" : "wall", key.j)
            .append(" ")
            .append(info.b),
        info.kind, number_or_none(info.stiffness_ratio > 0, info.stiffness_ratio),
        number_or_none(std::isfinite(info.overlap_limit), info.overlap_limit),
        number_or_none(info.damage_number_limit > 0, info.damage_number_limit),
        number_or_none(std::isfinite(info.onset_speed), info.onset_speed),
        number_or_none(info.dt_overlap > 0, info.dt_overlap), info.law, error_text(info));
  }
  if (lines.empty()) return lines;
  return fmt::format(
      "granulaw contact laws (error bound: 95 % of impacts, head-on, frictionless, one contact at a time)\n"
      "  {:<24} {:<18} {:>9} {:>9} {:>9} {:>11} {:>10}  {}\n{}",
      "types", "kind of law", "E*/Y", "max d/R*", "max I", "yields m/s", "dt to d/R*", "law; error bound",
      lines);
}

std::string end_table(const ContactStatistics& sum, const DeckUnits& units, const DeepContacts& deep,
                      double largest_dt)
{
  const ContactStatistics::Pair pair = sum.total(false).in_si(units), wall = sum.total(true).in_si(units),
                                all = sum.total().in_si(units);
  std::string table = row("granulaw contacts", "particles", "walls").substr(2);
  table += row("contacts begun", "{:.0f}", pair.touches, wall.touches);
  table += row("largest approach speed, m/s", "{:.4g}", pair.speed_max, wall.speed_max);
  table += row("largest overlap/R*", "{:.4g}", pair.overlap_max, wall.overlap_max);
  for (const MechanismText& m : mechanisms)
    if (m.shown_if_zero || all.taken[m.which] > 0)
      table += row(m.words, "{:.6g}", pair.taken[m.which], wall.taken[m.which]);
  if (all.damage_number_max > 0)
    table += row("largest I = rho V^2/Y", "{:.3g}", pair.damage_number_max, wall.damage_number_max);
  if (all.frequency2 > 0) {
    const auto allowed = [](const ContactStatistics::Pair& side) {
      return number_or_none(std::isfinite(side.dt_allowed()), side.dt_allowed());
    };
    table += row("time step that the stiffest allowed, s", allowed(pair), allowed(wall));
    table += fmt::format("  {:<42} {:>14.4g}\n", "time step used, s", largest_dt);
  }
  return table + limits_text(sum, all, deep);
}

}  // namespace granulaw::plugin
