#pragma once

#include "atlas/atlas.hpp"
#include "base/progress.hpp"
#include "farm/farm.hpp"

namespace granulaw {

struct AtlasRequest
{
  const Atlas* known = nullptr;  ///< whose materials stay; null: all are run
  bool impacts_anew = false;     ///< but their fast impacts, which are run
  bool radii_alone = false;      ///< all of it stays but the radii of unloading, by presses of few materials
  bool midplane_alone = false;   ///< all of it stays but the midplane presses, which are run
  int checks = 500;              ///< fresh impacts, which measure its error
  int midplane_checks = 100;     ///< fresh midplane presses, which measure theirs
  unsigned seed = 1;             ///< of the materials of both
};

/// The atlas: all materials of the grid, the fresh impacts that give the error, then midplane presses and
/// fresh ones of these.
Atlas make_atlas(const AtlasRequest& request, Farm& farm, const Progress& progress = {});

}  // namespace granulaw
