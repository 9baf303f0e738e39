#pragma once

#include "atlas/atlas.hpp"
#include "atlas/law_range.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// What a law made of runs must reach, and who makes the runs.
struct BuildOptions : LawRange
{
  const Atlas* atlas = nullptr;  ///< spares runs where a stiff body begins to yield; none: nothing but runs
  Farm* farm = nullptr;          ///< makes the runs; none: this thread
  Progress progress;             ///< may throw to stop
};

}  // namespace granulaw
