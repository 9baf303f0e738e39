#include "deck/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>

#include "base/error.hpp"
#include "deck/process.hpp"
#include "liggghts_plugin/plan/scene_json.hpp"

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;
/// From the deck's units.
void to_si(Scene& scene)
{
  if (scene.units == "si") return;
  if (scene.units != "cgs")
    fail(scene.deck, "its units cannot be planned with (LIGGGHTS's own, where a deck says none, are lj)", "units " + scene.units, "units si, units cgs");
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
  }
  for (Wall& wall : scene.walls) {
    for (double* value : {&wall.speed, &wall.drag_speed, &wall.push_speed, &wall.level_push_speed, &wall.lift}) *value *= length;
    scale(wall.box);
  }
}

/// A path or place of a deck that was read in `folder`.
std::string from(const std::string& folder, const std::string& path)
{
  return folder.empty() || path.empty() || path.starts_with('/') ? path : (fs::path(folder) / path).string();
}

/// Places and files of its own count from `folder`, those of its commands stay as the deck has them.
void to_folder(Scene& scene, const std::string& folder)
{
  const auto place = [&](std::string& path) { path = from(folder, path); };
  for (std::string* path : {&scene.law_file, &scene.left_loop, &scene.stopped_at}) place(*path);
  for (auto* list : {&scene.notes, &scene.unknown_particles, &scene.unknown_speeds})
    for (std::string& sentence : *list) place(sentence);
  for (Source& s : scene.sources) place(s.where);
  for (Wall& w : scene.walls) place(w.where);
  for (Run& r : scene.runs) place(r.where);
}

/// The last command of the shell that LIGGGHTS hands on: none is run while it only reads.
std::string not_run(const Scene& scene)
{
  const auto hands_on = [](const DeckCommand& c) {
    static const std::set<std::string> own{"cd", "mkdir", "mv", "rm", "rmdir", "putenv"};
    return c.words.size() > 1 && c.words[0] == "shell" && !own.contains(c.words[1]);
  };
  const auto last = std::find_if(scene.commands.rbegin(), scene.commands.rend(), hands_on);
  if (last == scene.commands.rend()) return "";
  return fmt::format(" ('{}' of line {} was not run: a plan starts no program)", fmt::join(last->words, " "), last->line);
}

[[noreturn]] void refuse(const std::string& deck, const DryRun& run)
{
  const std::string where = run.scene.stopped_at.empty() ? deck : run.scene.stopped_at;
  const std::string what = complaint(run.said);
  if (what.starts_with("LIGGGHTS was ended by signal")) fail(where, what + " in this command: where LIGGGHTS runs the deck, please report it");
  if (what.starts_with("Cannot open restart file "))
    fail(where, "the restart file is not there: the deck that writes it must run first, some steps suffice", what.substr(25));
  if (what == "Substitution for illegal variable") fail(where, "a variable has no value here (" + what + "): give it by --var NAME VALUE");
  fail(where, what + not_run(run.scene));
}

}  // namespace

std::string complaint(const std::string& said)
{
  static const std::regex pattern(R"((^|\n)ERROR( on proc \d+)?: ([^\n]*))");
  std::smatch found;
  if (!std::regex_search(said, found, pattern)) return "LIGGGHTS cannot read it: " + said.substr(said.size() - std::min<std::size_t>(said.size(), 300));
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

Scene read_scene(const std::string& deck, const Presets& presets, bool also_from_here)
{
  std::error_code ignored;
  if (!fs::is_regular_file(deck, ignored)) fail(deck, "cannot be read");
  const fs::path path(deck);
  // its paths count from its own folder, or, as `liggghts -in FOLDER/DECK` has it, from where one stands
  std::string folder = path.parent_path().string();
  DryRun run = dry_run(folder, words_of(path.filename().string(), presets));
  if (!run.ended && also_from_here && !folder.empty()) {
    if (DryRun from_here = dry_run("", words_of(deck, presets)); from_here.ended) {
      run = std::move(from_here);
      folder.clear();
    }
  }
  to_folder(run.scene, folder);
  if (!run.ended) refuse(deck, run);
  Scene scene = std::move(run.scene);
  scene.deck = deck;
  scene.folder = folder;
  scene.presets = presets;
  to_si(scene);
  return scene;
}

namespace {

/// liggghts-mpm: of the environment, or that which came with this program.
std::string launcher()
{
  if (const char* chosen = std::getenv("GRANULAW_LAUNCHER"); chosen && *chosen) return std::filesystem::absolute(chosen).string();
  if (const std::string own = own_file("liggghts-mpm"); !own.empty()) return own;
  fail("", "LIGGGHTS reads the deck, and liggghts-mpm is not beside this program (set GRANULAW_LAUNCHER to its path)");
}

/// Words and file of a process.
struct Output
{
  bool ended = false;  ///< without an error
  std::string said;
  nlohmann::json file;  ///< discarded: it is none
};

/// liggghts-mpm with an option that takes a path as its last value.
Output start_launcher(const std::string& folder, const std::vector<std::string>& option, const std::vector<std::string>& words)
{
  const int file = memory_file("the plan");
  Process process{.words = {launcher()}, .folder = folder};
  process.words.insert(process.words.end(), option.begin(), option.end());
  process.words.push_back(fmt::format("/dev/fd/{}", file));
  process.words.insert(process.words.end(), words.begin(), words.end());
  Ended ended = run_process(process);
  if (ended.exit == 127) fail(process.words[0], "cannot be started");
  if (ended.signal) ended.said += fmt::format("\nERROR: LIGGGHTS was ended by signal {} ({})\n", ended.signal, strsignal(ended.signal));
  lseek(file, 0, SEEK_SET);
  Output result{ended.exit == 0, std::move(ended.said), nlohmann::json::parse(read_all(file), nullptr, false)};
  close(file);
  return result;
}

}  // namespace

DryRun dry_run(const std::string& folder, const std::vector<std::string>& words)
{
  Output run = start_launcher(folder, {"-plan"}, words);
  const bool is_scene = run.file.is_object();
  return {run.ended && is_scene, is_scene ? run.file.get<Scene>() : Scene{}, std::move(run.said)};
}

ShortRun short_run(const std::string& folder, const std::vector<std::string>& words, long long steps)
{
  std::vector<std::string> quiet = words;
  quiet.insert(quiet.end(), {"-log", "none"});
  const Output run = start_launcher(folder, {"-steps", fmt::format("{}", steps)}, quiet);
  ShortRun result;
  result.said = run.said;
  const nlohmann::json& state = run.file;
  result.ended = run.ended && state.is_object();
  if (!result.ended) return result;
  result.steps = state["steps"], result.time = state["time"];
  result.particles = state["particles"], result.files = state["files_written"];
  const nlohmann::json& energy = state["kinetic_energy"];  // null: no number
  result.kinetic_energy = energy.is_null() ? std::numeric_limits<double>::quiet_NaN() : energy.get<double>();
  return result;
}

}  // namespace granulaw::deck
