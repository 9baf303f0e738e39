#pragma once

#include "characterise/run/sampling_plan.hpp"
#include "atlas/atlas.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// The presses that MidplaneShapes are made of: an elastic one for each Poisson's ratio, three of each
/// material.
std::vector<RunJob> midplane_jobs(const MidplaneGrid& grid, const RunSource& source);

/// The midplane shapes from these presses' results, in the order of midplane_jobs(); `free`: the
/// atlas's laws of free spheres.
MidplaneShapes midplane_from(const Atlas& free, const MidplaneGrid& grid,
                             const std::vector<RunOutcome>& outcomes);

/// Fresh midplane presses of random materials, evenly in ln(E*/Y), in nu, and in ln(H/E) from 0.001 (a
/// quarter are perfectly plastic), to depths of 0.01 to 0.3 R, evenly in the logarithm, and 3 times the
/// onset's at least: what the atlas says of them.
std::vector<MidplaneCheck> check_midplane(const Atlas& atlas, Farm& farm, int count, unsigned seed,
                                          const Progress& progress);

}  // namespace granulaw
