#pragma once

#include "characterise/atlas_file.hpp"

namespace granulaw::tests {

/// The atlas of the source tree.
inline Atlas own_atlas()
{
  return read_atlas(GRANULAW_ATLAS_FILE);
}

}  // namespace granulaw::tests
