#include "deck/scene.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/error.hpp"
#include "deck/launcher.hpp"

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// From the deck's units.
void to_si(Scene& scene)
{
  if (scene.units == "si") return;
  if (scene.units != "cgs")
    fail(scene.deck, "its units cannot be planned with (LIGGGHTS's own, where a deck says none, are lj)",
         "units " + scene.units, "units si, units cgs");
  constexpr double length = 0.01, density = 1000, pressure = 0.1;
  const auto scale = [](Box& box) {
    box.low = length * box.low;
    box.high = length * box.high;
  };
  scene.gravity = length * scene.gravity;
  scale(scene.domain);
  for (auto& [type, m] : scene.materials) {
    if (m.youngs_modulus) *m.youngs_modulus *= pressure;
    if (m.yield_stress) *m.yield_stress *= pressure;
  }
  for (Source& s : scene.sources) {
    for (double* value : {&s.radius_min, &s.radius_max, &s.speed}) *value *= length;
    s.density *= density;
    scale(s.centres);
    for (Vec3& p : s.together) p = length * p;
  }
  for (Wall& wall : scene.walls) {
    for (double* value : {&wall.speed, &wall.drag_speed, &wall.push_speed, &wall.level_push_speed, &wall.lift}) *value *= length;
    scale(wall.box);
  }
}

/// Paths and places of a deck that was read in `folder`.
class Places
{
 public:
  explicit Places(std::string folder) : folder_(std::move(folder)) {}
  std::string path(const std::string& of_deck) const
  {
    return folder_.empty() || of_deck.empty() || of_deck.starts_with('/')
               ? of_deck
               : (fs::path(folder_) / of_deck).string();
  }
  std::vector<std::string> sentences(const json& list) const
  {
    std::vector<std::string> result;
    for (const json& item : list) result.push_back(path(item.get<std::string>()));
    return result;
  }

 private:
  std::string folder_;
};

std::optional<double> optional_number(const json& value)
{
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

/// An infinite side is null.
Box box_of(const json& j)
{
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!j["low"][k].is_null()) box.low[k] = j["low"][k];
    if (!j["high"][k].is_null()) box.high[k] = j["high"][k];
  }
  return box;
}

Source source_of(const json& j, const Places& places)
{
  Source s;
  s.where = places.path(j["where"]);
  s.type = j["type"];
  s.radius_min = j["radius"][0], s.radius_max = j["radius"][1];
  s.density = j["density"];
  s.centres = box_of(j["centres"]);
  s.speed = j["speed"], s.count = j["count"];
  for (const json& p : j["together"]) s.together.push_back(p.get<Vec3>());
  return s;
}

Wall wall_of(const json& j, const Places& places)
{
  return {places.path(j["where"]), j["id"],         j["type"],  box_of(j["box"]), j["speed"],
          j["drag_speed"],         j["deformable"], j["model"], j["push_speed"],  j["level_push_speed"], j["lift"]};
}

TypeMaterial material_of(const json& j)
{
  return {optional_number(j["youngs_modulus"]), optional_number(j["poisson_ratio"]),
          optional_number(j["yield_stress"])};
}

DeckCommand command_of(const json& j)
{
  const std::string where = j["where"];
  const auto colon = where.rfind(':');
  return {where.substr(0, colon), std::stoi(where.substr(colon + 1)), j["words"]};
}

Scene scene_of(const json& j, const Places& places)
{
  Scene scene;
  scene.units = j["units"];
  scene.gravity = j["gravity"].get<Vec3>();
  scene.domain = box_of(j["domain"]);
  scene.periodic = j["periodic"];
  scene.dimension = j["dimension"];
  scene.types = j["types"];
  scene.time_step = j["time_step"];
  for (const json& m : j["materials"]) scene.materials[m["type"]] = material_of(m);
  scene.restart_stretch = optional_number(j["restart_stretch"]);
  scene.restitution = optional_number(j["restitution"]);
  scene.friction = j["friction"].get<std::vector<double>>();
  const json& style = j["pair_style"];
  scene.model = style["model"];
  scene.law_file = places.path(style["law"]);
  scene.material_names = style["materials"];
  scene.stretch = style["stretch"];
  scene.yield_pressure = style["yield_pressure"];
  for (const json& s : j["sources"]) scene.sources.push_back(source_of(s, places));
  for (const json& w : j["walls"]) scene.walls.push_back(wall_of(w, places));
  for (const json& r : j["runs"])
    scene.runs.push_back({places.path(r["where"]), r["steps"], r["time_step"], r["particles"], r["integrates"]});
  scene.left_loop = places.path(j["left_loop"]);
  scene.notes = places.sentences(j["notes"]);
  scene.unknown_particles = places.sentences(j["unknown_particles"]);
  scene.unknown_speeds = places.sentences(j["unknown_speeds"]);
  for (const json& c : j["commands"]) scene.commands.push_back(command_of(c));
  scene.files_read = j["files_read"];
  scene.files_written = j["files_written"];
  return scene;
}

[[noreturn]] void refuse(const std::string& deck, const DryRun& run, const Places& places)
{
  std::string where = deck;
  if (!run.scene.empty())
    if (const std::string at = json::parse(run.scene)["stopped_at"]; !at.empty()) where = places.path(at);
  const std::string what = complaint(run.said);
  if (what.starts_with("LIGGGHTS was ended by signal"))
    fail(where, what + " in this command: where LIGGGHTS runs the deck, please report it");
  if (what.starts_with("Cannot open restart file "))
    fail(where, "the restart file is not there: the deck that writes it must run first, some steps suffice",
         what.substr(25));
  if (what == "Substitution for illegal variable")
    fail(where, "a variable has no value here (" + what + "): give it by --var NAME VALUE");
  fail(where, what);
}

}  // namespace

std::string complaint(const std::string& said)
{
  static const std::regex pattern(R"((^|\n)ERROR( on proc \d+)?: ([^\n]*))");
  std::smatch found;
  if (!std::regex_search(said, found, pattern))
    return "LIGGGHTS cannot read it: " + said.substr(said.size() - std::min<std::size_t>(said.size(), 300));
  return std::regex_replace(found[3].str(), std::regex(R"( \([^()]*\.(cpp|h):\d+\)$)"), "");
}

std::vector<std::string> words_of(const std::string& deck, const Presets& presets)
{
  std::vector<std::string> words{"-in", deck};
  for (const auto& [name, values] : presets) {
    words.insert(words.end(), {"-var", name});
    words.insert(words.end(), values.begin(), values.end());
  }
  return words;
}

double Scene::count() const
{
  double sum = 0;
  for (const Source& s : sources) sum += s.count;
  return sum;
}

Scene read_scene(const std::string& deck, const Presets& presets)
{
  std::error_code ignored;
  if (!fs::is_regular_file(deck, ignored)) fail(deck, "cannot be read");
  const fs::path path(deck);
  // its paths count from its own folder, or, as `liggghts -in FOLDER/DECK` has it, from where one stands
  std::string folder = path.parent_path().string();
  DryRun run = dry_run(folder, words_of(path.filename().string(), presets));
  if (!run.ended && !folder.empty()) {
    if (DryRun from_here = dry_run("", words_of(deck, presets)); from_here.ended) {
      run = std::move(from_here);
      folder.clear();
    }
  }
  const Places places(folder);
  if (!run.ended) refuse(deck, run, places);
  Scene scene = scene_of(json::parse(run.scene), places);
  scene.deck = deck;
  scene.folder = folder;
  scene.presets = presets;
  to_si(scene);
  return scene;
}

}  // namespace granulaw::deck
