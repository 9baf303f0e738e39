#include "deck/launcher.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/error.hpp"
#include "deck/process.hpp"
#include "liggghts_plugin/plan/scene_json.hpp"

namespace granulaw::deck {

namespace {

/// liggghts-mpm: of the environment, or that which came with this program.
std::string launcher()
{
  if (const char* chosen = std::getenv("GRANULAW_LAUNCHER"); chosen && *chosen) return std::filesystem::absolute(chosen).string();
  if (const std::string own = own_file("liggghts-mpm"); !own.empty()) return own;
  fail("mpm", "LIGGGHTS reads the deck, and liggghts-mpm is not beside this program (set GRANULAW_LAUNCHER to its path)");
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
  const int file = memory_file("mpm");
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
