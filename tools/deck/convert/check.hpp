#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deck/launcher.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

/// Some hundred steps of original and converted deck.
struct Checked
{
  ShortRun before, after;
  std::vector<std::string> files_missing, files_new;  ///< written by one of them alone
};

/// Runs both where they stand, without writing a file: 300 steps of the original, `step_factor` times as many of the converted deck.
Checked check(const Scene& scene, const std::filesystem::path& folder, double step_factor);

}  // namespace granulaw::deck
