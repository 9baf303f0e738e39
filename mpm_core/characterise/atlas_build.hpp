#pragma once

#include "characterise/atlas.hpp"
#include "characterise/survey.hpp"

namespace granulaw {

/// Every run that an atlas needs: elastic presses, then the surveys of all its materials.
std::vector<RunJob> atlas_jobs(const AtlasGrid& grid, const RunSource& source);

/// The atlas from these runs' results, in the order of atlas_jobs(). Very stiff materials yield at overlaps
/// where no run is affordable: there the law of a less stiff one at the same delta/delta_onset holds, but for a
/// term that goes as sqrt(delta/R), that is as Y/E*: two less stiff shapes tell it.
Atlas atlas_from(const AtlasGrid& grid, const std::vector<RunOutcome>& outcomes);

}  // namespace granulaw
