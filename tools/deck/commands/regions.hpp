#pragma once

#include "deck/commands/handlers.hpp"
#include "deck/geometry.hpp"

namespace granulaw::deck {

struct Region
{
  Box box;
  double volume = 0;
};

/// `region ID STYLE ...`
void follow_region(Reading& reading, Words words);

}  // namespace granulaw::deck
