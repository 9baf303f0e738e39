#pragma once

#include "atlas/atlas.hpp"
#include "atlas/law_range.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// Range and tolerance of a law made of runs, and the farm that makes the runs.
struct BuildOptions : LawRange
{
  const Atlas* atlas = nullptr;  ///< spares runs where a stiff body begins to yield; none: nothing but runs
  Farm* farm = nullptr;          ///< makes the runs; none: this thread
  Progress progress;             ///< may throw to stop
};

}  // namespace granulaw
