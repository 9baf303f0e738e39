#pragma once

#include <string>
#include <vector>

#include "deck/geometry.hpp"

namespace granulaw::deck {

/// Vertices of a triangle mesh: STL as text or binary, or the POINTS of a VTK text file. Throws Error.
std::vector<Vec3> mesh_vertices(const std::string& path);

}  // namespace granulaw::deck
