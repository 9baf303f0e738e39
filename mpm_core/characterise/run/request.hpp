#pragma once

#include <vector>

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

/// Impacts of a certificate over orientations.
struct ShapeQuestion
{
  int directions = 30;             ///< over all that the body's mirror planes leave
  std::vector<double> velocities;  ///< m/s, over 0
  int resolution = 8;              ///< cells across the contact block of each run
};

}  // namespace granulaw
