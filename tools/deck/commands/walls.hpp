#pragma once

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// `fix ID group wall/gran... model ... primitive|mesh ...`
void follow_wall(Reading& reading, const Fix& fix, Words words);
/// Other walls than wall/gran.
void refuse_wall(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
