#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atlas/atlas.hpp"

// Files that came with the program: its atlas, and the scripts that draw.
namespace granulaw {

/// The atlas that came with the program: $GRANULAW_ATLAS, else atlas.h5 beside the program or where
/// cmake --install puts it; empty if there is none.
std::string atlas_path();

/// That atlas, read; none if there is none. Throws Error if it cannot be used.
std::optional<Atlas> own_atlas();

/// Runs a Python script of the program (beside it or installed) with these words, `input` on its stdin, to
/// draw the picture `output`. `command` leads messages. Throws Error with the last line of what the script
/// complained of.
void draw_by_python(const char* command, const std::string& script, const std::vector<std::string>& words, const std::string& input, const std::string& output);

}  // namespace granulaw
