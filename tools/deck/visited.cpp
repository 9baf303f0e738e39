// What a run visited: the JSON file of fix granulaw/stats.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "deck/plan.hpp"

namespace granulaw::deck {

namespace {

using nlohmann::json;

double number_at(const json& object, std::initializer_list<const char*> keys)
{
  for (const char* key : keys)
    if (const auto at = object.find(key); at != object.end() && at->is_number()) return at->get<double>();
  return 0;
}

Visited::Range range_of(const json& side)
{
  Visited::Range r;
  r.speed = number_at(side, {"impact_speed_max_m_per_s"});
  r.overlap = number_at(side, {"overlap_over_radius_max"});
  r.damage_number = number_at(side, {"inertia_number_max"});
  r.met = number_at(side, {"contacts_begun"}) > 0 || r.speed > 0;
  return r;
}

}  // namespace

Visited read_visited(const std::string& path)
{
  std::error_code ignored;
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "cannot be read");
  json root;
  try {
    root = json::parse(in);
  } catch (const json::exception&) {
    fail(path, "is no JSON file of fix granulaw/stats");
  }
  Visited v;
  v.path = path;
  if (!root.is_object()) fail(path, "is no JSON file of fix granulaw/stats");
  if (const auto at = root.find("pair"); at != root.end() && at->is_object()) v.pair = range_of(*at);
  if (const auto at = root.find("wall"); at != root.end() && at->is_object()) v.wall = range_of(*at);
  if (const auto list = root.find("pairs"); list != root.end() && list->is_array())
    for (const json& entry : *list) {
      if (!entry.is_object()) continue;
      const auto types = entry.find("types");
      int a = static_cast<int>(number_at(entry, {"type_i", "i"})),
          b = static_cast<int>(number_at(entry, {"type_j", "j"}));
      if (types != entry.end() && types->is_array() && types->size() == 2 &&
          (*types)[0].is_number_integer() && (*types)[1].is_number_integer())
        a = (*types)[0].get<int>(), b = (*types)[1].get<int>();
      if (a < 1 || b < 1) continue;
      const auto kind = entry.find("kind");
      const bool wall = kind != entry.end() && kind->is_string() &&
                        kind->get<std::string>().find("wall") != std::string::npos;
      // rigid and deformable walls of one type are one meeting of the plan
      auto& into = wall ? v.walls[{a, b}] : v.pairs[{std::min(a, b), std::max(a, b)}];
      const Visited::Range r = range_of(entry);
      into.speed = std::max(into.speed, r.speed), into.overlap = std::max(into.overlap, r.overlap);
      into.damage_number = std::max(into.damage_number, r.damage_number), into.met = into.met || r.met;
    }
  if (!v.pair && !v.wall && v.pairs.empty() && v.walls.empty())
    fail(path, "holds no contacts", "", "the JSON file of fix granulaw/stats");
  return v;
}

}  // namespace granulaw::deck
