#include "liggghts_plugin/plan/record.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace granulaw::plugin::plan {

namespace {

using nlohmann::json;

json to_json(const Box& box)
{
  return {{"low", box.low}, {"high", box.high}};  // an infinite side becomes null
}

json to_json(const std::optional<double>& value)
{
  return value ? json(*value) : json();
}

json to_json(const Source& s)
{
  return {{"where", s.where},
          {"type", s.type},
          {"radius", {s.radius_min, s.radius_max}},
          {"density", s.density},
          {"centres", to_json(s.centres)},
          {"speed", s.speed},
          {"count", s.count},
          {"together", s.together}};
}

json to_json(const Wall& w)
{
  return {{"where", w.where},           {"id", w.id},
          {"model", w.model},           {"type", w.type},
          {"box", to_json(w.box)},      {"speed", w.speed},
          {"drag_speed", w.drag_speed}, {"deformable", w.deformable},
          {"push_speed", w.push_speed}, {"level_push_speed", w.level_push_speed}, {"lift", w.lift}};
}

json to_json(const Run& r)
{
  return {{"where", r.where}, {"steps", r.steps}, {"time_step", r.time_step}, {"particles", r.particles}, {"integrates", r.integrates}};
}

json to_json(const Command& c)
{
  return {{"where", c.where}, {"words", c.words}};
}

template <class Item>
json list(const std::vector<Item>& items)
{
  json result = json::array();
  for (const Item& item : items) result.push_back(to_json(item));
  return result;
}

void add(std::vector<std::string>& list, const std::string& text)
{
  if (std::find(list.begin(), list.end(), text) == list.end() && list.size() < 200) list.push_back(text);
}

}  // namespace

double Record::count() const
{
  double sum = 0;
  for (const Source& s : sources) sum += s.count;
  return sum;
}

void Record::note(const std::string& text)
{
  add(notes, text);
}

void Record::ask_speed(const std::string& text)
{
  add(unknown_speeds, text);
}

void Record::add_command(Command command)
{
  constexpr std::size_t most = 20000, variants = 16;
  std::vector<std::size_t>& at_place = places_[command.where];
  for (const std::size_t k : at_place)
    if (commands[k].words == command.words) return;
  if (commands.size() >= most || at_place.size() >= variants) return;
  at_place.push_back(commands.size());
  commands.push_back(std::move(command));
}

void Record::add_file(const std::string& path, bool is_written)
{
  std::vector<std::string>& list = is_written ? files_written : files_read;
  if (std::find(list.begin(), list.end(), path) == list.end() && list.size() < 1000) list.push_back(path);
}

std::vector<double> Record::fingerprint() const
{
  std::vector<double> all{time_step, static_cast<double>(notes.size() + unknown_speeds.size())};
  const auto add_box = [&](const Box& box) {
    all.insert(all.end(), box.low.begin(), box.low.end());
    all.insert(all.end(), box.high.begin(), box.high.end());
  };
  all.insert(all.end(), gravity.begin(), gravity.end());
  for (const Source& s : sources) {
    all.insert(all.end(), {s.radius_min, s.radius_max, s.density, s.speed, s.count});
    add_box(s.centres);
  }
  for (const Wall& w : walls) {
    all.insert(all.end(), {w.speed, w.drag_speed, w.push_speed, w.level_push_speed, w.lift});
    add_box(w.box);
  }
  return all;
}

std::string Record::json() const
{
  nlohmann::json types_list = nlohmann::json::array();
  for (const auto& [type, m] : materials)
    types_list.push_back({{"type", type},
                          {"youngs_modulus", to_json(m.youngs_modulus)},
                          {"poisson_ratio", to_json(m.poisson_ratio)},
                          {"yield_stress", to_json(m.yield_stress)}});
  const nlohmann::json root{
      {"units", units},
      {"gravity", gravity},
      {"domain", to_json(domain)},
      {"periodic", periodic},
      {"dimension", dimension},
      {"types", types},
      {"materials", types_list},
      {"restitution", to_json(restitution)},
      {"friction", friction},
      {"pair_style", {{"model", model}, {"law", law}, {"materials", material_names}, {"stretch", stretch}, {"yield_pressure", yield_pressure}}},
      {"sources", list(sources)},
      {"walls", list(walls)},
      {"runs", list(runs)},
      {"time_step", time_step},
      {"notes", notes},
      {"unknown_particles", unknown_particles},
      {"unknown_speeds", unknown_speeds},
      {"commands", list(commands)},
      {"files_read", files_read},
      {"files_written", files_written},
      {"restart_stretch", to_json(restart_stretch)},
      {"left_loop", left_loop},
      {"stopped_at", stopped_at}};
  return root.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string Record::json_of_stop(const std::string& where)
{
  return nlohmann::json{{"stopped_at", where}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace granulaw::plugin::plan
