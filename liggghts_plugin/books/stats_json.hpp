#pragma once

#include <string>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin {

/// `contact statistics` (summed over ranks, in the deck's units) as JSON, in SI; `header` is placed first
/// ("\"key\": value,\n" lines). Schema: docs/reference/fix_granulaw_stats.md.
/// As a JSON string.
std::string quoted(const std::string& text);

std::string to_json(const ContactStatistics& statistics, const std::string& header, const DeckUnits& units);

}  // namespace granulaw::plugin
