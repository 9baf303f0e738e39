#pragma once

#include <string>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin {

/// Text as a JSON string.
std::string quoted(const std::string& text);

/// `contact statistics` (summed over ranks, in the deck's units) as JSON, in SI; `header` is placed first
/// ("\"key\": value,\n" lines). Schema: docs/reference/fix_granulaw_stats.md.
std::string to_json(const ContactStatistics& statistics, const std::string& header, const DeckUnits& units);

}  // namespace granulaw::plugin
