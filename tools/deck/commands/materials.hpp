#pragma once

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// `fix ID group property/global NAME KIND VALUE...`
void follow_property(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
