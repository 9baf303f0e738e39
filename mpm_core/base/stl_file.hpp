#pragma once

#include <array>
#include <string>
#include <vector>

namespace granulaw {

/// The bytes of a mesh file, up to 512 MB. Throws Error naming the path if it cannot be read.
std::string read_mesh_bytes(const std::string& path);

/// The length distinguishes a binary STL from text: some binary ones begin with "solid", too.
bool is_binary_stl(const std::string& bytes);

/// Corners of the triangles of an STL, three for each, in its unit of length. A text is read by its words
/// 'vertex'; none of them: no corners. `path` leads the Error if numbers are missing.
std::vector<std::array<double, 3>> stl_corners(const std::string& bytes, const std::string& path);

}  // namespace granulaw
