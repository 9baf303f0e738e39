#pragma once

#include <string>

#include "deck/words.hpp"

namespace granulaw::deck {

struct Reading;

/// Of `fix ID group STYLE ...`; its handler gets the words behind the style.
struct Fix
{
  std::string id, style;
};

/// Handlers throw Unknown where they cannot follow the command, and Error where the deck cannot be used.
using CommandHandler = void (*)(Reading& reading, Words words);
using FixHandler = void (*)(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
