#pragma once

#include "characterise/atlas_file.hpp"

namespace granulaw::testing {

/// The atlas of the source tree.
inline Atlas own_atlas()
{
  return read_atlas(GRANULAW_ATLAS_FILE);
}

}  // namespace granulaw::testing
