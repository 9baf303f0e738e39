#pragma once

#include "characterise/atlas.hpp"

namespace granulaw {

/// Rms errors of an atlas's laws, by its own checks: what its file certifies.
struct AtlasErrors
{
  double restitution = 0;     ///< of e, absolute
  double force = 0;           ///< relative
  double midplane_force = 0;  ///< relative
  double recovery =
      0;  ///< of an unloading, relative to the largest overlap less the residual; by midplane presses
};

/// Computed once for an atlas.
const AtlasErrors& errors_of(const Atlas& atlas);

}  // namespace granulaw
