#pragma once

#include <string>
#include <vector>

#include "liggghts_plugin/plan/geometry.hpp"
#include "liggghts_plugin/plan/scene.hpp"

namespace granulaw::deck {

/// LIGGGHTS's own sentence of what it said, without the place in its source.
std::string complaint(const std::string& said);
/// As LIGGGHTS takes them: -in DECK -var NAME VALUE...
std::vector<std::string> words_of(const std::string& deck, const Presets& presets);

/// LIGGGHTS reads the deck (`liggghts-mpm -plan`). Throws Error where that program is missing, or with LIGGGHTS's own
/// sentence where the deck, or a file that it needs, cannot be used. `also_from_here`: its paths may count from where one stands.
Scene read_scene(const std::string& deck, const Presets& presets = {}, bool also_from_here = true);

/// Result of `liggghts-mpm -plan`.
struct DryRun
{
  bool ended = false;  ///< it read the deck to its end
  Scene scene;         ///< in the deck's units
  std::string said;    ///< on stdout and stderr
};

/// `words` behind `-plan FILE`, started in `folder`. Throws Error where the program is missing.
DryRun dry_run(const std::string& folder, const std::vector<std::string>& words);

/// Some steps of a deck, of any models, as it is.
struct ShortRun
{
  bool ended = false;  ///< without an error
  std::string said;
  double steps = 0, time = 0, particles = 0, kinetic_energy = 0;  ///< in the deck's units
  std::vector<std::string> files;                                 ///< that it would have written
};

/// `liggghts-mpm -steps STEPS` with these words, started in `folder`. Nothing is written there, and no command of the shell is run.
ShortRun short_run(const std::string& folder, const std::vector<std::string>& words, long long steps);

}  // namespace granulaw::deck
