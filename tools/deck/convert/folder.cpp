#include "deck/convert/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "base/atomic_write.hpp"
#include "base/error.hpp"

namespace granulaw::deck {

namespace fs = std::filesystem;

namespace {

constexpr const char* original = "Original: ";

bool is_restart(const Scene& scene, const std::string& path)
{
  return std::any_of(
      scene.commands.begin(), scene.commands.end(), [&](const DeckCommand& c) { return c.words.size() > 1 && c.words[0] == "read_restart" && c.words[1] == path; });
}

std::string text_of(const fs::path& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The line of the page that has it; empty: there is no page, or none of a conversion.
std::string owner_of(const fs::path& page)
{
  std::ifstream in(page);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(original)) return line;
  return {};
}

bool continues(const Scene& scene, const fs::path& folder)
{
  return std::any_of(scene.files_read.begin(), scene.files_read.end(),
      [&](const std::string& path) { return is_restart(scene, path) && fs::exists(folder / path_within(scene, path)); });
}

/// Files of commands that are there.
std::map<std::string, std::string> commands_there(const Scene& scene, const fs::path& folder)
{
  std::map<std::string, std::string> texts;
  for (const auto& [path, text] : command_files(scene))
    if (const fs::path at = folder / name_in_folder(scene, path); fs::exists(at)) texts[at.string()] = text_of(at);
  return texts;
}

[[noreturn]] void fail_for_file(const fs::path& path)
{
  fail("-o", "the folder has a file of this name, and no conversion of this deck wrote it: name another folder, or move the file away", path.string());
}

}  // namespace

std::string original_line(const Scene& scene, const fs::path& folder)
{
  const fs::path deck = fs::weakly_canonical(scene.deck);
  return original + deck.lexically_relative(fs::weakly_canonical(folder)).string();
}

Destination open_destination(const Scene& scene, const fs::path& folder)
{
  Destination d;
  d.folder = folder;
  const std::string own = original_line(scene, folder), owner = owner_of(folder / d.page);
  d.is_own = owner == own;
  if (!d.is_own && !owner.empty()) {
    if (!continues(scene, folder))
      fail("-o",
          fmt::format(
              "it holds the conversion of another deck ({}): name another folder. A deck that continues from a restart file goes into the same folder once the converted deck before has written the file",
              printable(owner.substr(std::string(original).size()))),
          folder.string());
    const std::string deck = fs::path(scene.deck).filename().string();
    d.law = deck + "." + d.law, d.page = deck + "." + d.page;
    d.shared = commands_there(scene, folder);
    if (owner_of(folder / d.page) == own) d.shared.erase((folder / deck).string());
  } else if (!d.is_own) {
    for (const std::string& name : {d.law, d.page})
      if (fs::exists(folder / name)) fail_for_file(folder / name);
    if (const auto there = commands_there(scene, folder); !there.empty()) fail_for_file(there.begin()->first);
  }
  fs::create_directories(folder);
  if (!fs::exists(folder / d.page)) write_text_atomically((folder / d.page).string(), own + "\n\nThe conversion has not ended.\n");
  return d;
}

void require_shared_files(const Destination& d)
{
  for (const auto& [path, text] : d.shared) {
    if (text_of(path) == text) continue;
    for (const auto& [other, before] : d.shared) write_text_atomically(other, before);
    fail("-o", "the conversion of the deck before has this file with another text: name another folder, and copy the restart file there first", path);
  }
}

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

std::vector<std::string> copy_data(const Scene& scene, const Destination& destination)
{
  const fs::path& folder = destination.folder;
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
    if (!destination.is_own && fs::exists(to) && text_of(to) != text_of(from)) fail_for_file(to);
    fs::create_directories(to.parent_path());
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }
  const auto make_folder_of = [&](const std::string& path, bool if_there) {
    const fs::path parent = fs::path(path).parent_path();
    if (parent.empty() || path.starts_with('/')) return;
    std::error_code ignored;
    if (!if_there || fs::is_directory(path_of(scene, parent.string()), ignored)) fs::create_directories(folder / path_within(scene, parent.string()), ignored);
  };
  for (const std::string& path : scene.files_written) make_folder_of(path, false);
  for (const DeckCommand& command : scene.commands)
    for (const std::string& word : command.words)
      if (word.find('/') != std::string::npos) make_folder_of(word, true);
  return restarts;
}

}  // namespace granulaw::deck
