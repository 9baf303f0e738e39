#pragma once

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// `pair_style gran model ...` with the keywords of the plug-in (liggghts_plugin/deck_keywords.hpp).
void follow_pair_style(Reading& reading, Words words);

}  // namespace granulaw::deck
