#pragma once

#include "deck/commands/reading.hpp"
#include "deck/script.hpp"

namespace granulaw::deck {

/// Adds to `reading` what one command says. Where it cannot be followed, a note says why. Throws Error where
/// the deck cannot be used.
void follow(Reading& reading, const Command& command);

}  // namespace granulaw::deck
