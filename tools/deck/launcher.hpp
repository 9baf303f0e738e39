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

}  // namespace granulaw::deck
