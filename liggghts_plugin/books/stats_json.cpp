#include "liggghts_plugin/books/stats_json.hpp"

#include <fmt/format.h>

namespace granulaw::plugin {

std::string quoted(const std::string& text)
{
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

namespace {

std::string histogram_json(const LogHistogram& histogram, const char* quantity)
{
  int low = 0, high = LogHistogram::bins - 1;
  while (low < high && histogram.count[low] == 0) ++low;
  while (high > low && histogram.count[high] == 0) --high;
  std::string edges, counts;
  for (int b = low; b <= high; ++b) {
    edges += fmt::format("{}{:.6g}", b > low ? ", " : "", histogram.lower_edge(b));
    counts += fmt::format("{}{:.10g}", b > low ? ", " : "", histogram.count[b]);
  }
  return fmt::format(
      "{{\"quantity\": \"{}\", \"bins_per_decade\": {}, \"lower_edge\": [{}], \"count\": [{}]}}", quantity,
      LogHistogram::per_decade, edges, counts);
}

/// The part of the map that holds something: rows by speed, columns by overlap.
std::string map_json(const ContactStatistics::Pair& s)
{
  constexpr int bins = LogHistogram::bins;
  int low[2] = {bins, bins}, high[2] = {-1, -1};
  for (int k = 0; k < bins * bins; ++k) {
    if (s.map[static_cast<std::size_t>(k)] == 0) continue;
    const int at[2] = {k / bins, k % bins};
    for (int axis = 0; axis < 2; ++axis)
      low[axis] = std::min(low[axis], at[axis]), high[axis] = std::max(high[axis], at[axis]);
  }
  std::string edges[2], rows;
  const LogHistogram* axes[2] = {&s.speed, &s.overlap};
  for (int axis = 0; axis < 2; ++axis)
    for (int b = low[axis]; b <= high[axis]; ++b)
      edges[axis] += fmt::format("{}{:.6g}", b > low[axis] ? ", " : "", axes[axis]->lower_edge(b));
  for (int i = low[0]; i <= high[0]; ++i) {
    std::string row;
    for (int j = low[1]; j <= high[1]; ++j)
      row += fmt::format("{}{:.10g}", j > low[1] ? ", " : "", s.map[static_cast<std::size_t>(i * bins + j)]);
    rows += fmt::format("{}[{}]", i > low[0] ? ", " : "", row);
  }
  return fmt::format(
      "{{\"quantity\": \"contacts that ended, by approach speed at first touch (rows), m/s, and largest "
      "overlap/R* (columns)\", \"bins_per_decade\": {}, \"speed_lower_edge\": [{}], "
      "\"overlap_lower_edge\": [{}], \"count\": [{}]}}",
      LogHistogram::per_decade, edges[0], edges[1], rows);
}

/// JSON has no infinity: null.
std::string number(double value)
{
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "null";
}

/// The counts of a pair, as the inside of a JSON object.
std::string counts_json(const ContactStatistics::Pair& s, const std::string& indent)
{
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    text += fmt::format("{}{}\"{}\": {}", text.empty() ? "" : ",\n", indent, name, value);
  };
  for (const Quantity& q : quantities)
    if (q.key) add(q.key, number(q.value.of(s)));
  add("inertia_number_max", number(s.damage_number_max));  // the older name of the damage number
  add("time_step_allowed_s", number(s.dt_allowed()));
  add("impact_speed", histogram_json(s.speed, "approach speed at first touch, m/s"));
  add("largest_overlap_over_radius",
      histogram_json(s.overlap, "largest overlap/R* of each contact that ended"));
  if (!s.map.empty()) text += fmt::format(",\n{}\"contact_map\": {}", indent, map_json(s));
  return text;
}

const char* kind_name(int kind)
{
  return kind == PairKey::particles    ? "particles"
         : kind == PairKey::rigid_wall ? "rigid wall"
                                       : "deformable wall";
}

std::string pair_json(const PairKey& key, const ContactStatistics::Pair& s)
{
  const PairInfo& info = s.info;
  const std::string damage_number_limit =
      info.damage_number_limit > 0 ? number(info.damage_number_limit) : "null";
  return fmt::format(
      "    {{\n      \"kind\": \"{}\",\n      \"types\": [{}, {}],\n      \"materials\": [{}, {}],\n"
      "      \"law\": {},\n      \"rule\": {},\n      \"overlap_over_radius_limit\": {},\n"
      "      \"damage_number_limit\": {},\n      \"inertia_number_limit\": {},\n      "
      "\"onset_speed_m_per_s\": {},\n"
      "      \"time_step_limit_of_law_s\": {},\n      \"overlap_over_radius_limit_of_time_step\": {},\n{}\n    }}",
      kind_name(key.kind), key.i, key.j, quoted(info.a), quoted(info.b), quoted(info.law), quoted(info.kind),
      number(info.overlap_limit), damage_number_limit, damage_number_limit, number(info.onset_speed),
      info.dt_limit > 0 ? number(info.dt_limit) : "null",
      info.dt_limit > 0 ? number(info.dt_overlap) : "null", counts_json(s, "      "));
}

}  // namespace

std::string to_json(const ContactStatistics& statistics, const std::string& header, const DeckUnits& units)
{
  std::string pairs;
  for (const auto& [key, counts] : statistics.pairs)
    if (counts.info.needed || counts.touches > 0)
      pairs += fmt::format("{}{}", pairs.empty() ? "" : ",\n", pair_json(key, counts.in_si(units)));
  return fmt::format(
      "{{\n{}  \"pair\": {{\n{}\n  }},\n  \"wall\": {{\n{}\n  }},\n  \"pairs\": [\n{}\n  ]\n}}\n", header,
      counts_json(statistics.total(false).in_si(units), "    "),
      counts_json(statistics.total(true).in_si(units), "    "), pairs);
}

}  // namespace granulaw::plugin
