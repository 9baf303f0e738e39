#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deck/convert/check.hpp"
#include "deck/convert/choices.hpp"
#include "deck/convert/convert.hpp"
#include "deck/convert/folder.hpp"
#include "deck/plan.hpp"

namespace granulaw::deck {

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
