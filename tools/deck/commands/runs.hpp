#pragma once

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// `run N [upto]`
void follow_run(Reading& reading, Words words);

}  // namespace granulaw::deck
