#pragma once

#include <string>
#include <vector>

#include "solver/runs.hpp"

namespace granulaw {

/// The planes that press a body: a named arrangement, or a file with one plane a line,
///
///     nx ny nz [distance [speed [friction]]]
///
/// where `distance` may be `touch`, and # begins a comment. Throws Error; `option` leads it where the name is
/// neither.
std::vector<PressPlane> read_planes(const std::string& name_or_file, const std::string& option = "planes");

}  // namespace granulaw
