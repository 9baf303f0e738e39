#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "deck/convert/convert.hpp"

// The folder of a converted deck.
namespace granulaw::deck {

/// A folder that is written into, and the names there of what one deck alone has.
struct Destination
{
  std::filesystem::path folder;
  std::string law = "law.h5", page = "conversion.md";
  bool is_own = true;                         ///< this deck's files may be replaced
  std::map<std::string, std::string> shared;  ///< files of commands of another deck there, which must stay as they are
};
/// Makes the folder. It is new, or of this deck's conversion before, or of a deck from whose restart file there this one
/// continues. Throws Error where a file of another origin would be lost.
Destination open_destination(const Scene& scene, const std::filesystem::path& folder);
/// Throws Error, and puts them back, where files of commands of another deck were changed.
void require_shared_files(const Destination& destination);
/// The line of a conversion's page by which its deck is known again.
std::string original_line(const Scene& scene, const std::filesystem::path& folder);

/// The name of a file of commands in that folder.
std::filesystem::path name_in_folder(const Scene& scene, const std::string& path);

/// Writes files of commands, texts by path as the deck calls them.
void write_files(const Scene& scene, const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

/// Copies the files that the deck reads, and makes the folders that it writes into. The restart files of the original
/// that were copied.
std::vector<std::string> copy_data(const Scene& scene, const Destination& destination);

}  // namespace granulaw::deck
