#pragma once

#include <string>
#include <vector>

#include "solver/runs.hpp"

namespace granulaw {

/// The planes of --planes: a named arrangement, or a file with one plane a line,
///
///     nx ny nz [distance [speed [friction]]]
///
/// where `distance` may be `touch`, and # begins a comment. Throws Error.
std::vector<PressPlane> read_planes(const std::string& name_or_file);

}  // namespace granulaw
