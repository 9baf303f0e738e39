#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deck/convert/choices.hpp"
#include "deck/convert/convert.hpp"
#include "deck/convert/folder.hpp"
#include "deck/plan.hpp"
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

/// A conversion and its result.
struct Converted
{
  PlannedDeck planned;
  Conversion conversion;
  ConvertedDeck result;
  Destination destination;
  std::filesystem::path folder, deck;
  StepChoice step;
  std::vector<std::string> law_pairs, accepted, restarts;
  std::optional<Checked> checked;
};

std::vector<std::string> check_lines(const Checked& checked);
std::string time_step_line(const Converted& converted);
/// Advice where contacts yield that stick; empty: none.
std::string tangential_line(const Converted& converted);
/// The command that runs it.
std::string run_line(const Converted& converted);
/// conversion.md. `command`: the words that made it.
std::string page(const Converted& converted, const std::string& command);

}  // namespace granulaw::deck
