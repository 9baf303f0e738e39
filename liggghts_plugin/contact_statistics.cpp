#include "liggghts_plugin/contact_statistics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace granulaw::plugin {

namespace {

constexpr std::size_t key_length = 3;
constexpr std::size_t side_length = key_length + ContactStatistics::Pair::sums +
                                    ContactStatistics::Pair::maxima + ContactStatistics::Pair::minima +
                                    2 * LogHistogram::bins;

/// First number of pack(); negative, as no kind of a key is.
constexpr double layout = -static_cast<double>(side_length);
constexpr int map_record = 100;  // added to the kind of a key in pack(): what follows is its map

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

std::string quoted(const std::string& text)
{
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

/// The counts of a pair, as the inside of a JSON object.
std::string counts_json(const ContactStatistics::Pair& s, const std::string& indent)
{
  const std::pair<const char*, std::string> entries[] = {
      {"normal_dissipation_J", number(s.dissipated)},
      {"other_work_J", number(s.other_work)},
      {"contacts_begun", number(s.touches)},
      {"contacts_ended", number(s.ended)},
      {"impact_speed_min_m_per_s", number(s.speed_min)},
      {"impact_speed_max_m_per_s", number(s.speed_max)},
      {"overlap_over_radius_min", number(s.overlap_min)},
      {"overlap_over_radius_max", number(s.overlap_max)},
      {"damage_number_max", number(s.damage_number_max)},
      {"inertia_number_max", number(s.damage_number_max)},
      {"contacts_near_table_edge", number(s.near)},
      {"contacts_past_table", number(s.past)},
      {"contact_steps_beyond_table", number(s.beyond)},
      {"contacts_beyond_speed_axis", number(s.too_fast)},
      {"contacts_below_speed_axis", number(s.too_slow)},
      {"contacts_begun_overlapping", number(s.sudden)},
      {"energy_of_overlapping_starts_J", number(s.brought)},
      {"time_step_allowed_s", number(s.dt_allowed())},
      {"impact_speed", histogram_json(s.speed, "approach speed at first touch, m/s")},
      {"largest_overlap_over_radius",
       histogram_json(s.overlap, "largest overlap/R* of each contact that ended")},
  };
  std::string text;
  for (const auto& [name, value] : entries)
    text += fmt::format("{}{}\"{}\": {}", text.empty() ? "" : ",\n", indent, name, value);
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
      "      \"time_step_limit_of_law_s\": {},\n{}\n    }}",
      kind_name(key.kind), key.i, key.j, quoted(info.a), quoted(info.b), quoted(info.law), quoted(info.rule),
      number(info.overlap_limit), damage_number_limit, damage_number_limit, number(info.onset_speed),
      info.dt_limit > 0 ? number(info.dt_limit) : "null", counts_json(s, "      "));
}

}  // namespace

const std::array<double, LogHistogram::bins> LogHistogram::upper_ratio = [] {
  std::array<double, bins> ratio{};
  for (int b = 0; b < bins; ++b) ratio[static_cast<std::size_t>(b)] = std::pow(10.0, (b + 1.0) / per_decade);
  return ratio;
}();

const std::array<std::size_t, LogHistogram::octaves> LogHistogram::first_of_octave = [] {
  std::array<std::size_t, octaves> first{};
  for (std::size_t k = 0; k < octaves; ++k)
    while (first[k] + 1 < bins && std::pow(10.0, (static_cast<double>(first[k]) + 1.0) / per_decade) <=
                                      std::ldexp(1.0, static_cast<int>(k)))
      ++first[k];
  return first;
}();

void ContactStatistics::Pair::merge(const Pair& other)
{
  Pair copy = other;
  const auto mine = numbers(), theirs = copy.numbers();
  for (int k = 0; k < sums; ++k) *mine[k] += *theirs[k];
  for (int k = sums; k < sums + maxima; ++k) *mine[k] = std::max(*mine[k], *theirs[k]);
  for (int k = sums + maxima; k < sums + maxima + minima; ++k) *mine[k] = std::min(*mine[k], *theirs[k]);
  for (int b = 0; b < LogHistogram::bins; ++b) {
    speed.count[b] += other.speed.count[b];
    overlap.count[b] += other.overlap.count[b];
  }
  if (other.map.empty()) return;
  if (map.empty()) open_map();
  for (std::size_t k = 0; k < map.size(); ++k) map[k] += other.map[k];
}

void ContactStatistics::Pair::count_ended()
{
  ended = 0;
  overlap_min = std::numeric_limits<double>::infinity();
  // a contact may be older than the counts, which begin at zero where a restart file holds none
  for (double& one : overlap.count) one = std::max(0.0, one);
  for (double& one : map) one = std::max(0.0, one);
  for (int b = LogHistogram::bins - 1; b >= 0; --b) {
    ended += overlap.count[static_cast<std::size_t>(b)];
    if (overlap.count[static_cast<std::size_t>(b)] > 0) overlap_min = overlap.lower_edge(b);
  }
}

ContactStatistics::Pair ContactStatistics::Pair::in_si(const DeckUnits& units) const
{
  Pair si = *this;
  for (double* energy : {&si.dissipated, &si.other_work, &si.brought}) *energy *= units.energy();
  for (double* one : {&si.speed_min, &si.speed_max, &si.speed.first, &si.info.onset_speed})
    *one *= units.length;
  return si;
}

ContactStatistics::Pair ContactStatistics::total(bool walls) const
{
  Pair sum;
  for (const auto& [key, counts] : pairs)
    if ((key.kind != PairKey::particles) == walls) sum.merge(counts);
  return sum;
}

ContactStatistics::Pair ContactStatistics::total() const
{
  Pair sum = total(false);
  sum.merge(total(true));
  return sum;
}

std::vector<double> ContactStatistics::pack() const
{
  std::vector<double> values{layout};
  for (const auto& [key, counts] : pairs) {
    Pair copy = counts;
    values.insert(values.end(),
                  {static_cast<double>(key.kind), static_cast<double>(key.i), static_cast<double>(key.j)});
    for (const double* value : copy.numbers()) values.push_back(*value);
    values.insert(values.end(), copy.speed.count.begin(), copy.speed.count.end());
    values.insert(values.end(), copy.overlap.count.begin(), copy.overlap.count.end());
  }
  for (const auto& [key, counts] : pairs) {
    if (counts.map.empty()) continue;
    values.insert(values.end(), {static_cast<double>(map_record + key.kind), static_cast<double>(key.i),
                                 static_cast<double>(key.j), 0.0});
    const std::size_t length = values.size() - 1;
    for (std::size_t k = 0; k < counts.map.size(); ++k)
      if (counts.map[k] != 0) values.insert(values.end(), {static_cast<double>(k), counts.map[k]});
    values[length] = static_cast<double>(values.size() - length - 1);
  }
  return values;
}

bool ContactStatistics::unpack(const double* values, std::size_t count, bool sums)
{
  if (count == 0 || values[0] != layout) return false;
  for (auto& [key, counts] : pairs) {
    Pair fresh;
    fresh.info = counts.info;
    if (!counts.map.empty()) fresh.open_map();
    counts = fresh;
  }
  const double *v = values + 1, *end = values + count;
  for (; v + side_length <= end && v[0] < map_record; v += side_length) {
    Pair& counts = pairs[{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])}];
    const auto numbers = counts.numbers();
    const double* from = v + key_length;
    for (std::size_t k = sums ? 0 : Pair::sums; k < numbers.size(); ++k) *numbers[k] = from[k];
    if (!sums) continue;
    from += numbers.size();
    std::copy_n(from, LogHistogram::bins, counts.speed.count.begin());
    std::copy_n(from + LogHistogram::bins, LogHistogram::bins, counts.overlap.count.begin());
  }
  if (!sums) return true;
  while (v + key_length < end) {
    Pair& counts =
        pairs[{static_cast<int>(v[0]) - map_record, static_cast<int>(v[1]), static_cast<int>(v[2])}];
    counts.open_map();
    const double* record_end = std::min(end, v + key_length + 1 + static_cast<std::size_t>(v[key_length]));
    for (v += key_length + 1; v + 1 < record_end; v += 2)
      if (v[0] >= 0 && v[0] < static_cast<double>(counts.map.size()))
        counts.map[static_cast<std::size_t>(v[0])] = v[1];
    v = record_end;
  }
  return true;
}

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
        or_none(std::isfinite(info.onset_speed), info.onset_speed), or_none(info.dt_limit > 0, info.dt_limit),
        info.law, info.error);
  }
  if (lines.empty()) return lines;
  return fmt::format("granulaw contact laws\n  {:<24} {:<18} {:>9} {:>9} {:>9} {:>11} {:>10}  {}\n{}",
                     "types", "pair rule", "E*/Y", "max d/R*", "max I", "yields m/s", "max dt s",
                     "law; error", lines);
}

}  // namespace granulaw::plugin
