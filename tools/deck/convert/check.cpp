#include "deck/convert/check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "deck/convert/convert.hpp"
#include "deck/convert/folder.hpp"

namespace granulaw::deck {

namespace {

namespace fs = std::filesystem;

/// A folder that is removed in the end.
class Scratch
{
 public:
  explicit Scratch(const fs::path& folder) : path_(folder) { fs::create_directories(path_); }
  ~Scratch()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::set<std::string> files_below(const fs::path& folder)
{
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

/// Names without the number of the step.
std::set<std::string> without_numbers(const std::set<std::string>& files)
{
  std::set<std::string> names;
  for (const std::string& file : files) {
    std::string name;
    for (const char ch : file) {
      const bool digit = ch >= '0' && ch <= '9';
      if (!digit) name += ch;
      else if (name.empty() || name.back() != '*') name += '*';
    }
    names.insert(name);
  }
  return names;
}

struct Trial
{
  ShortRun run;
  std::set<std::string> written;
};

/// Runs a deck in a copy of its data.
Trial try_deck(const fs::path& data, const fs::path& scratch, const std::map<std::string, std::string>& files,
               const Scene& scene, const std::string& name, long long steps)
{
  fs::copy(data, scratch, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  write_files(scene, scratch, files);
  const std::set<std::string> before = files_below(scratch);
  Trial trial;
  trial.run = short_run(scratch.string(), words_of(name, scene.presets), steps);
  const std::set<std::string> after = files_below(scratch);
  std::set<std::string> written;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::inserter(written, written.end()));
  trial.written = without_numbers(written);
  return trial;
}

}  // namespace

Checked check(const Scene& scene, const fs::path& folder, double step_factor)
{
  constexpr long long steps = 300;
  const Scratch scratch(fs::temp_directory_path() / fmt::format("granulaw-check-{}", getpid()));
  const std::string name = fs::path(scene.deck).filename().string();
  const Trial before = try_deck(folder, scratch.path() / "original", command_files(scene), scene, name, steps);
  const double done = before.run.ended ? before.run.steps : static_cast<double>(steps);
  const Trial after = try_deck(folder, scratch.path() / "converted", {}, scene, name,
                               static_cast<long long>(std::ceil(done * step_factor)));
  Checked result{before.run, after.run, {}, {}};
  std::set_difference(before.written.begin(), before.written.end(), after.written.begin(), after.written.end(),
                      std::back_inserter(result.files_missing));
  std::set_difference(after.written.begin(), after.written.end(), before.written.begin(), before.written.end(),
                      std::back_inserter(result.files_new));
  return result;
}

}  // namespace granulaw::deck
