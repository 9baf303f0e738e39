#include "deck/launcher.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/error.hpp"
#include "liggghts_plugin/plan/scene_json.hpp"

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;

/// liggghts-mpm: of the environment, beside this program, or where a build has it.
std::string launcher()
{
  if (const char* chosen = std::getenv("GRANULAW_LAUNCHER"); chosen && *chosen) return chosen;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : {"liggghts-mpm", "../../liggghts_plugin/liggghts-mpm"})
    if (fs::exists(here / place)) return (here / place).string();
  fail("mpm",
       "LIGGGHTS reads the deck, and liggghts-mpm is not beside this program (set GRANULAW_LAUNCHER to its "
       "path)");
}

std::string read_all(int end)
{
  std::string all;
  char part[65536];
  for (ssize_t length; (length = read(end, part, sizeof part)) > 0;)
    all.append(part, static_cast<std::size_t>(length));
  return all;
}

/// Open MPI would take a program that a rank starts for the rank itself.
void leave_mpi()
{
  std::vector<std::string> names;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    for (const char* prefix :
         {"PMIX_", "PMI_", "OMPI_COMM_", "OMPI_UNIVERSE_", "OMPI_MCA_orte", "OMPI_MCA_ess_base"})
      if (text.starts_with(prefix)) names.push_back(text.substr(0, text.find('=')));
  }
  for (const std::string& name : names) unsetenv(name.c_str());
}

[[noreturn]] void start(const std::string& folder, const std::vector<std::string>& words, int output)
{
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  leave_mpi();
  if (folder.empty() || chdir(folder.c_str()) == 0) execv(arguments[0], arguments.data());
  _exit(127);
}

/// Words and file of a process.
struct Output
{
  bool ended = false;  ///< without an error
  std::string said;
  nlohmann::json file;  ///< discarded: it is none
};

/// liggghts-mpm with an option that takes a path as its last value.
Output start_launcher(const std::string& folder, const std::vector<std::string>& option,
                      const std::vector<std::string>& words)
{
  const std::string program = fs::absolute(launcher()).string();
  const int scene = memfd_create("scene", 0);
  int output[2];
  if (scene < 0 || pipe(output) != 0) fail(program, "cannot make a pipe");
  std::vector<std::string> command{program};
  command.insert(command.end(), option.begin(), option.end());
  command.push_back(fmt::format("/dev/fd/{}", scene));
  command.insert(command.end(), words.begin(), words.end());
  const pid_t child = fork();
  if (child == 0) start(folder, command, output[1]);
  close(output[1]);
  Output result;
  result.said = read_all(output[0]);
  close(output[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
    fail(program, "cannot be started");
  if (WIFSIGNALED(status))
    result.said += fmt::format("\nERROR: LIGGGHTS was ended by signal {} ({})\n", WTERMSIG(status), strsignal(WTERMSIG(status)));
  result.ended = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  lseek(scene, 0, SEEK_SET);
  result.file = nlohmann::json::parse(read_all(scene), nullptr, false);
  close(scene);
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
