#include "deck/visited.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace granulaw::deck {

namespace {

using nlohmann::json;

double number_at(const json& object, const char* key)
{
  const auto at = object.find(key);
  return at != object.end() && at->is_number() ? at->get<double>() : 0;
}

Visited::Range range_of(const json& side)
{
  Visited::Range r;
  r.speed = number_at(side, "impact_speed_max_m_per_s");
  r.overlap = number_at(side, "overlap_over_radius_max");
  r.damage_number = number_at(side, "damage_number_max");
  r.met = number_at(side, "contacts_begun") > 0 || r.speed > 0;
  return r;
}

json parsed(const std::string& path)
{
  std::error_code ignored;
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "cannot be read");
  json root = json::parse(in, nullptr, false);
  if (!root.is_object()) fail(path, "is no JSON file of fix granulaw/stats");
  return root;
}

/// The two types of an entry; 0 where it does not say them.
std::pair<int, int> types_of(const json& entry)
{
  if (const auto types = entry.find("types");
      types != entry.end() && types->is_array() && types->size() == 2 && (*types)[0].is_number_integer() && (*types)[1].is_number_integer())
    return {(*types)[0].get<int>(), (*types)[1].get<int>()};
  return {0, 0};
}

bool is_wall(const json& entry)
{
  const auto kind = entry.find("kind");
  return kind != entry.end() && kind->is_string() && kind->get<std::string>().find("wall") != std::string::npos;
}

/// Rigid and deformable walls of one type are one range: the larger of each.
void widen(Visited::Range& range, const Visited::Range& by)
{
  range.speed = std::max(range.speed, by.speed);
  range.overlap = std::max(range.overlap, by.overlap);
  range.damage_number = std::max(range.damage_number, by.damage_number);
  range.met = range.met || by.met;
}

}  // namespace

std::optional<Visited::Range> Visited::range(int a, int b, bool is_wall) const
{
  if (pairs.empty() && walls.empty()) return is_wall ? wall : pair;  // the file does not distinguish types
  const auto& by_types = is_wall ? walls : pairs;
  const auto found = by_types.find(is_wall ? std::pair(a, b) : std::pair(std::min(a, b), std::max(a, b)));
  return found == by_types.end() ? Range{} : found->second;
}

Visited read_visited(const std::string& path)
{
  const json root = parsed(path);
  Visited v;
  v.path = path;
  if (const auto at = root.find("pair"); at != root.end() && at->is_object()) v.pair = range_of(*at);
  if (const auto at = root.find("wall"); at != root.end() && at->is_object()) v.wall = range_of(*at);
  if (const auto list = root.find("pairs"); list != root.end() && list->is_array())
    for (const json& entry : *list) {
      if (!entry.is_object()) continue;
      const auto [a, b] = types_of(entry);
      if (a < 1 || b < 1) continue;
      widen(is_wall(entry) ? v.walls[{a, b}] : v.pairs[{std::min(a, b), std::max(a, b)}], range_of(entry));
    }
  if (!v.pair && !v.wall && v.pairs.empty() && v.walls.empty()) fail(path, "holds no contacts", "", "the JSON file of fix granulaw/stats");
  return v;
}

}  // namespace granulaw::deck
