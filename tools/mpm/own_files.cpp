#include "own_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "base/error.hpp"
#include "characterise/atlas_file.hpp"
#include "deck/process.hpp"

namespace granulaw {

std::string atlas_path()
{
  if (const char* chosen = std::getenv("GRANULAW_ATLAS"); chosen && *chosen) return chosen;
  return own_file("atlas.h5");
}

std::optional<Atlas> own_atlas()
{
  const std::string path = atlas_path();
  if (path.empty()) return std::nullopt;
  return read_atlas(path);
}

void draw_by_python(const char* command, const std::string& script, const std::vector<std::string>& words, const std::string& input, const std::string& output)
{
  // a whole path: by "python3" alone Python looks for its modules beside the PATH's first one
  Process process{.words = {GRANULAW_PYTHON, own_file(script)}, .keeps_stdout = true};
  if (process.words[1].empty()) fail(command, fmt::format("{} is not beside the program", script));
  process.words.insert(process.words.end(), words.begin(), words.end());
  process.input = memory_file(command, input);
  Ended ended = run_process(process);
  close(process.input);
  if (ended.exit == 127) fail(command, fmt::format("{} is missing (Debian: python3-matplotlib, python3-h5py)", process.words[0]));
  if (ended.exit == 0) return;
  std::string& said = ended.said;
  while (said.ends_with('\n')) said.pop_back();  // a traceback's last line says what went wrong
  fail(output, "cannot be drawn", said.substr(said.rfind('\n') + 1));
}

}  // namespace granulaw
