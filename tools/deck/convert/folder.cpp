#include "deck/convert/folder.hpp"

#include <algorithm>
#include <set>

#include "base/atomic_write.hpp"

namespace granulaw::deck {

namespace fs = std::filesystem;

namespace {

bool is_restart(const Scene& scene, const std::string& path)
{
  return std::any_of(scene.commands.begin(), scene.commands.end(), [&](const DeckCommand& c) {
    return c.words.size() > 1 && c.words[0] == "read_restart" && c.words[1] == path;
  });
}

}  // namespace

fs::path name_in_folder(const Scene& scene, const std::string& path)
{
  const bool is_main = fs::path(path).lexically_normal() == fs::path(main_file(scene)).lexically_normal();
  if (is_main || path.starts_with('/')) return fs::path(path).filename();
  return fs::path(path_within(scene, path)).lexically_normal();
}

void write_files(const Scene& scene, const fs::path& folder, const std::map<std::string, std::string>& files)
{
  for (const auto& [path, text] : files) {
    const fs::path to = folder / name_in_folder(scene, path);
    fs::create_directories(to.parent_path());
    write_text_atomically(to.string(), text);
  }
}

std::vector<std::string> copy_data(const Scene& scene, const fs::path& folder)
{
  std::vector<std::string> restarts;
  std::set<std::string> commands;
  for (const DeckCommand& command : scene.commands) commands.insert(command.file);
  for (const std::string& path : scene.files_read) {
    if (path.starts_with('/') || commands.contains(path)) continue;
    const fs::path from = path_of(scene, path);
    std::error_code ignored;
    if (!fs::is_regular_file(from, ignored)) continue;
    const fs::path to = folder / path_within(scene, path);
    const bool restart = is_restart(scene, path);
    if (restart && fs::exists(to)) continue;  // of the deck before, converted
    if (restart) restarts.push_back(path);
    fs::create_directories(to.parent_path());
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }
  const auto make_folder_of = [&](const std::string& path, bool if_there) {
    const fs::path parent = fs::path(path).parent_path();
    if (parent.empty() || path.starts_with('/')) return;
    std::error_code ignored;
    if (!if_there || fs::is_directory(path_of(scene, parent.string()), ignored))
      fs::create_directories(folder / path_within(scene, parent.string()), ignored);
  };
  for (const std::string& path : scene.files_written) make_folder_of(path, false);
  for (const DeckCommand& command : scene.commands)
    for (const std::string& word : command.words)
      if (word.find('/') != std::string::npos) make_folder_of(word, true);
  return restarts;
}

}  // namespace granulaw::deck
