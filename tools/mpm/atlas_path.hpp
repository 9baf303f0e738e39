#pragma once

#include <optional>
#include <string>

#include "atlas/atlas.hpp"

namespace granulaw {

/// The atlas that came with the program: $GRANULAW_ATLAS, else atlas.h5 beside the program or where
/// cmake --install puts it; empty if there is none.
std::string atlas_path();

/// That atlas, read; none if there is none. Throws Error if it cannot be used.
std::optional<Atlas> own_atlas();

}  // namespace granulaw
