#pragma once

#include <string>
#include <vector>

namespace granulaw::deck {

/// Result of `liggghts-mpm -plan`.
struct DryRun
{
  bool ended = false;  ///< it read the deck to its end
  std::string scene;   ///< JSON (liggghts_plugin/plan/record.hpp)
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
};

/// `liggghts-mpm -steps STEPS` with these words, started in `folder`.
ShortRun short_run(const std::string& folder, const std::vector<std::string>& words, long long steps);

}  // namespace granulaw::deck
