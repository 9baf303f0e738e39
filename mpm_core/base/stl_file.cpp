#include "base/stl_file.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace granulaw {

namespace {

using Corners = std::vector<std::array<double, 3>>;

/// A binary STL: 80 bytes of title, the number of triangles, 50 bytes for each.
constexpr std::size_t stl_header = 84, stl_triangle = 50;

std::size_t binary_triangles(const std::string& bytes)
{
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + stl_header - sizeof count, sizeof count);
  return count;
}

Corners binary_corners(const std::string& bytes)
{
  Corners corners;
  for (std::size_t t = 0; t < binary_triangles(bytes); ++t) {
    float corner[9];
    std::memcpy(corner, bytes.data() + stl_header + stl_triangle * t + 12, sizeof corner);
    for (int v = 0; v < 3; ++v) corners.push_back({corner[3 * v], corner[3 * v + 1], corner[3 * v + 2]});
  }
  return corners;
}

}  // namespace

std::string read_mesh_bytes(const std::string& path)
{
  std::error_code ignored;
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "the mesh cannot be read");
  if (std::filesystem::file_size(path, ignored) > 512u << 20)
    fail(path, "the mesh is too large", "over 512 MB");
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

bool is_binary_stl(const std::string& bytes)
{
  return bytes.size() >= stl_header && bytes.size() == stl_header + stl_triangle * binary_triangles(bytes);
}

Corners stl_corners(const std::string& bytes, const std::string& path)
{
  if (is_binary_stl(bytes)) return binary_corners(bytes);
  Corners corners;
  std::istringstream words(bytes);
  std::string word;
  std::array<double, 3> p;
  while (words >> word)
    if (word == "vertex") {
      if (!(words >> p[0] >> p[1] >> p[2]))
        fail(path, "the mesh is damaged: three numbers must follow 'vertex'");
      corners.push_back(p);
    }
  return corners;
}

}  // namespace granulaw
