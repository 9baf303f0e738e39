#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "deck/convert/convert.hpp"

// The folder of a converted deck.
namespace granulaw::deck {

/// The name of a file of commands in that folder.
std::filesystem::path name_in_folder(const Scene& scene, const std::string& path);

/// Writes files of commands, texts by path as the deck calls them.
void write_files(const Scene& scene, const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

/// Copies the files that the deck reads, and makes the folders that it writes into. The restart files of the original
/// that were copied.
std::vector<std::string> copy_data(const Scene& scene, const std::filesystem::path& folder);

}  // namespace granulaw::deck
