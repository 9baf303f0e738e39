#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "liggghts_plugin/books/contact_statistics.hpp"

// The statistics file. Schema: docs/reference/fix_granulaw_stats.md.
namespace granulaw::plugin {

/// Number of so many digits; null where it is not finite.
nlohmann::ordered_json json_number(double value, int digits = 10);

/// Members "pair", "wall", "pairs" of contact statistics (summed over ranks, in the deck's units), in SI.
nlohmann::ordered_json to_json(const ContactStatistics& statistics, const DeckUnits& units);

/// Object as text: a line for each member, lists of numbers on one line.
std::string text_of(const nlohmann::ordered_json& object);

}  // namespace granulaw::plugin
