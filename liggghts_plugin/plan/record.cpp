#include "liggghts_plugin/plan/record.hpp"

#include <algorithm>

#include "liggghts_plugin/plan/scene_json.hpp"

namespace granulaw::plugin::plan {

namespace {

void add(std::vector<std::string>& list, const std::string& text)
{
  if (std::find(list.begin(), list.end(), text) == list.end() && list.size() < 200) list.push_back(text);
}

}  // namespace

void Record::note(const std::string& text)
{
  add(notes, text);
}

void Record::ask_speed(const std::string& text)
{
  add(unknown_speeds, text);
}

void Record::add_command(const std::string& where, std::vector<std::string> words)
{
  constexpr std::size_t most = 20000, variants = 16;
  std::vector<std::size_t>& at_place = places_[where];
  for (const std::size_t k : at_place)
    if (commands[k].words == words) return;
  if (commands.size() >= most || at_place.size() >= variants) return;
  at_place.push_back(commands.size());
  const auto colon = where.rfind(':');
  commands.push_back({where.substr(0, colon), std::stoi(where.substr(colon + 1)), std::move(words)});
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
  const nlohmann::json root = static_cast<const deck::Scene&>(*this);
  return root.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace granulaw::plugin::plan
