#pragma once

#include "characterise/atlas_file.hpp"

namespace granulaw::tests {

/// The atlas of the source tree, read once.
inline const Atlas& atlas()
{
  static const Atlas read = read_atlas(GRANULAW_ATLAS_FILE);
  return read;
}

inline const Atlas& own_atlas() { return atlas(); }

}  // namespace granulaw::tests
