#pragma once

#include <string>

#include "atlas/atlas.hpp"

namespace granulaw {

/// Reads and writes the atlas's file (HDF5; layout: docs/evidence/atlas.md). Throws Error.
Atlas read_atlas(const std::string& path);
void write_atlas(const Atlas& atlas, const std::string& path);

}  // namespace granulaw
