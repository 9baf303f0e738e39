#pragma once

#include "atlas/atlas.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"

namespace granulaw {

/// Data at hand before an atlas is built.
struct KnownAtlas
{
  const Atlas* atlas = nullptr;  ///< whose materials stay, are not run again; null: none
  bool impacts_anew = false;     ///< they stay but for what inertia changes: their fast impacts are run
};

/// Every run that an atlas needs: elastic presses, then the sampling plans of all its materials, but for what
/// is known.
std::vector<RunJob> atlas_jobs(const AtlasGrid& grid, const RunSource& source, const KnownAtlas& known = {});

/// The atlas from these runs' results, in the order of atlas_jobs() with the same `known`. Very stiff
/// materials yield at overlaps where no run is affordable: there the law of a less stiff one at the same
/// delta/delta_onset holds, but for a term that goes as sqrt(delta/R), that is as Y/E*: two less stiff shapes
/// give it.
Atlas atlas_from(const AtlasGrid& grid, const std::vector<RunOutcome>& outcomes,
                 const KnownAtlas& known = {});

/// Fresh impacts, each run as `mpm impact` would, of random materials and speeds, evenly in the logarithms of
/// E*/Y and of the speed from 1.5 times the onset's to I = 0.06, evenly in nu, a quarter of them perfectly
/// plastic and the others evenly in ln(H/E) from 0.001: what the atlas says of them against what they do.
/// Overlaps below 3e-4 R are drawn again: such an impact takes minutes.
std::vector<AtlasCheck> check_atlas(const Atlas& atlas, Farm& farm, int count, unsigned seed,
                                    const Progress& progress);

}  // namespace granulaw
