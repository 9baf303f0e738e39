#pragma once

#include "characterise/atlas.hpp"

namespace granulaw {

/// Rms errors of an atlas's laws, by its own checks: what its file certifies.
struct AtlasErrors
{
  double restitution = 0;        ///< of e, absolute
  double force = 0;              ///< relative
  double midplane_force = 0;     ///< relative
  double midplane_residual = 0;  ///< over the largest overlap
};

/// Computed once for an atlas.
const AtlasErrors& errors_of(const Atlas& atlas);

}  // namespace granulaw
