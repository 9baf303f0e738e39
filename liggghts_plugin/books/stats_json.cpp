#include "liggghts_plugin/books/stats_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace granulaw::plugin {

using Json = nlohmann::ordered_json;

Json json_number(double value, int digits)
{
  if (!std::isfinite(value)) return nullptr;
  constexpr double exact = 1e15;  // whole numbers up to here are written without a point
  const double rounded = std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
  if (rounded == std::trunc(rounded) && std::abs(rounded) < exact) return static_cast<std::int64_t>(rounded);
  return rounded;
}

namespace {

constexpr int edge_digits = 6;

Json lower_edges(const LogHistogram& histogram, int low, int high)
{
  Json edges = Json::array();
  for (int b = low; b <= high; ++b) edges.push_back(json_number(histogram.lower_edge(b), edge_digits));
  return edges;
}

Json histogram_json(const LogHistogram& histogram, const char* quantity)
{
  int low = 0, high = LogHistogram::bins - 1;
  while (low < high && histogram.count[low] == 0) ++low;
  while (high > low && histogram.count[high] == 0) --high;
  Json counts = Json::array();
  for (int b = low; b <= high; ++b) counts.push_back(json_number(histogram.count[b]));
  return {{"quantity", quantity},
          {"bins_per_decade", LogHistogram::per_decade},
          {"lower_edge", lower_edges(histogram, low, high)},
          {"count", counts}};
}

/// The part of the map that holds something: rows by speed, columns by overlap.
Json map_json(const ContactStatistics::Pair& s)
{
  constexpr int bins = LogHistogram::bins;
  int low[2] = {bins, bins}, high[2] = {-1, -1};
  for (int k = 0; k < bins * bins; ++k) {
    if (s.map[static_cast<std::size_t>(k)] == 0) continue;
    const int at[2] = {k / bins, k % bins};
    for (int axis = 0; axis < 2; ++axis)
      low[axis] = std::min(low[axis], at[axis]), high[axis] = std::max(high[axis], at[axis]);
  }
  Json rows = Json::array();
  for (int i = low[0]; i <= high[0]; ++i) {
    Json row = Json::array();
    for (int j = low[1]; j <= high[1]; ++j)
      row.push_back(json_number(s.map[static_cast<std::size_t>(i * bins + j)]));
    rows.push_back(row);
  }
  return {{"quantity",
           "contacts that ended, by approach speed at first touch (rows), m/s, and largest overlap/R* (columns)"},
          {"bins_per_decade", LogHistogram::per_decade},
          {"speed_lower_edge", lower_edges(s.speed, low[0], high[0])},
          {"overlap_lower_edge", lower_edges(s.overlap, low[1], high[1])},
          {"count", rows}};
}

/// Adds the counts of a pair to an object.
void add_counts(Json& object, const ContactStatistics::Pair& s)
{
  for (const Quantity& q : quantities)
    if (q.key) object[q.key] = json_number(q.value.of(s));
  object["inertia_number_max"] = json_number(s.damage_number_max);  // the older name of the damage number
  object["time_step_allowed_s"] = json_number(s.dt_allowed());
  object["impact_speed"] = histogram_json(s.speed, "approach speed at first touch, m/s");
  object["largest_overlap_over_radius"] =
      histogram_json(s.overlap, "largest overlap/R* of each contact that ended");
  if (!s.map.empty()) object["contact_map"] = map_json(s);
}

const char* kind_name(int kind)
{
  return kind == PairKey::particles    ? "particles"
         : kind == PairKey::rigid_wall ? "rigid wall"
                                       : "deformable wall";
}

/// Number, or null where it is not above 0: not known.
Json known(double value)
{
  return value > 0 ? json_number(value) : Json();
}

Json pair_json(const PairKey& key, const ContactStatistics::Pair& s)
{
  const PairInfo& info = s.info;
  Json pair{{"kind", kind_name(key.kind)},
            {"types", {key.i, key.j}},
            {"materials", {info.a, info.b}},
            {"law", info.law},
            {"rule", info.kind},
            {"overlap_over_radius_limit", json_number(info.overlap_limit)},
            {"damage_number_limit", known(info.damage_number_limit)},
            {"inertia_number_limit", known(info.damage_number_limit)},
            {"onset_speed_m_per_s", json_number(info.onset_speed)},
            {"time_step_limit_of_law_s", known(info.dt_limit)},
            {"overlap_over_radius_limit_of_time_step", info.dt_limit > 0 ? json_number(info.dt_overlap) : Json()}};
  add_counts(pair, s);
  return pair;
}

Json counts_json(const ContactStatistics::Pair& s)
{
  Json counts = Json::object();
  add_counts(counts, s);
  return counts;
}

void append(std::string& text, const Json& value, const std::string& indent)
{
  const bool holds_objects =
      value.is_array() && std::any_of(value.begin(), value.end(), [](const Json& one) { return one.is_object(); });
  if (!value.is_structured()) {
    text += value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  const bool spread = value.is_object() || holds_objects;
  const std::string within = spread ? '\n' + indent + "  " : "";
  text += value.is_object() ? '{' : '[';
  for (auto member = value.begin(); member != value.end(); ++member) {
    if (member != value.begin()) text += spread ? "," : ", ";
    text += within;
    if (value.is_object()) text += '"' + member.key() + "\": ";
    append(text, *member, indent + "  ");
  }
  if (spread && !value.empty()) text += '\n' + indent;
  text += value.is_object() ? '}' : ']';
}

}  // namespace

Json to_json(const ContactStatistics& statistics, const DeckUnits& units)
{
  Json pairs = Json::array();
  for (const auto& [key, counts] : statistics.pairs)
    if (counts.info.needed || counts.touches > 0) pairs.push_back(pair_json(key, counts.in_si(units)));
  return {{"pair", counts_json(statistics.total(false).in_si(units))},
          {"wall", counts_json(statistics.total(true).in_si(units))},
          {"pairs", pairs}};
}

std::string text_of(const Json& object)
{
  std::string text;
  append(text, object, "");
  return text + '\n';
}

}  // namespace granulaw::plugin
