#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/scene.hpp"

namespace granulaw::deck {

/// The choices of a conversion.
struct Conversion
{
  std::vector<std::string> materials;                   ///< name of each atom type
  std::map<int, double> youngs_modulus, poisson_ratio;  ///< by type, Pa: those that change
  double stretch = 1;
  double step_factor = 1;  ///< the time step is so many times shorter, every count of steps as much larger
  /// Definitions of variables for the time step change, and what is computed from them. False: the commands alone do.
  bool variables_follow = true;
  std::string law = "law.h5";
};

/// A line that was changed. Empty `after`: removed; empty `before`: added.
struct Change
{
  std::string where, before, after, why;
};

struct ConvertedDeck
{
  std::map<std::string, std::string> files;  ///< text by path, as the deck calls it
  std::vector<Change> changes;
  std::vector<std::string> left;  ///< "FILE:LINE: what could not be converted"
  bool followed = false;          ///< variables are computed from the time step
  bool more_follows = false;      ///< with words that are no counts of steps: a speed, a size
};

/// The file of a path in the deck, which LIGGGHTS reads from the scene's folder.
std::filesystem::path path_of(const Scene& scene, const std::string& path);
/// A path of the deck in the folder of the converted one: "../CFD/log" becomes "CFD/log", and that of a file in the
/// deck's own folder, "../DEM/log", becomes "log". So the converted deck runs wherever it stands, and what one deck
/// writes another one of the same folder finds.
std::string path_within(const Scene& scene, const std::string& path);
/// The deck itself, as its commands name their file.
std::string main_file(const Scene& scene);

/// Files of commands that LIGGGHTS read, and their texts. Throws Error where one cannot be read.
std::map<std::string, std::string> command_files(const Scene& scene);

/// Throws Error where the deck has nothing to convert.
ConvertedDeck convert(const Scene& scene, const Conversion& conversion);

/// Throws Error where the deck has neither pair_style gran nor fix wall/gran.
void require_contact_model(const Scene& scene);

/// The largest, s, of all runs that move particles; 0: none does.
double largest_time_step(const Scene& scene);

/// False where the deck's models or fixes have no form for a stretched law.
bool may_be_stretched(const Scene& scene);

}  // namespace granulaw::deck
