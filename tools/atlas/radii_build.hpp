#pragma once

#include "atlas/atlas.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// Materials whose presses give an atlas the radii of unloading that it lacks. These change more slowly with the material than
/// forces do, are asked for to a few per cent, and are taken from one Poisson's ratio (docs/evidence/unloading-radius.md).
struct RadiusGrid : Lattice
{
  RadiusGrid() : Lattice{0.3, {20, 30, 50, 100, 200, 500, 1500, 5000}, {0, 0.005, 0.02, 0.08, 0.3}, {}, {}, {}, 0.1} {}
};

/// Their presses: those that the atlas is made of (plan_sampling()).
std::vector<RunJob> radius_jobs(const RadiusGrid& grid, const RunSource& source);

/// The atlas with radii of unloading by these presses, in the order of radius_jobs(). Below the shallowest press a material
/// has those of the next softer one at the same overlap/onset.
Atlas with_radii(const Atlas& atlas, const RadiusGrid& grid, const std::vector<RunOutcome>& outcomes);

}  // namespace granulaw
