#include "deck/mesh_file.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace granulaw::deck {

namespace {

/// A binary STL: 80 bytes of title, the number of triangles, 50 bytes for each.
constexpr std::size_t stl_header = 84, stl_triangle = 50;

std::string contents(const std::string& path)
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

std::size_t binary_triangles(const std::string& text)
{
  std::uint32_t count = 0;
  std::memcpy(&count, text.data() + stl_header - sizeof count, sizeof count);
  return count;
}

/// The length tells a binary STL from text: some binary ones begin with "solid", too.
bool is_binary_stl(const std::string& text)
{
  return text.size() >= stl_header && text.size() == stl_header + stl_triangle * binary_triangles(text);
}

std::vector<Vec3> read_binary_stl(const std::string& text)
{
  std::vector<Vec3> vertices;
  for (std::size_t t = 0; t < binary_triangles(text); ++t) {
    float corner[9];
    std::memcpy(corner, text.data() + stl_header + stl_triangle * t + 12, sizeof corner);
    for (int v = 0; v < 3; ++v) vertices.push_back({corner[3 * v], corner[3 * v + 1], corner[3 * v + 2]});
  }
  return vertices;
}

std::vector<Vec3> read_text(const std::string& text, const std::string& path)
{
  std::vector<Vec3> vertices;
  std::istringstream words(text);
  std::string word;
  Vec3 p;
  while (words >> word) {
    if (word == "vertex") {  // STL
      if (!(words >> p[0] >> p[1] >> p[2]))
        fail(path, "the mesh is damaged: three numbers must follow 'vertex'");
      vertices.push_back(p);
    } else if (word == "POINTS") {  // VTK
      std::size_t n = 0;
      words >> n >> word;
      for (std::size_t k = 0; k < n && words >> p[0] >> p[1] >> p[2]; ++k) vertices.push_back(p);
      break;
    }
  }
  return vertices;
}

}  // namespace

std::vector<Vec3> mesh_vertices(const std::string& path)
{
  const std::string text = contents(path);
  const std::vector<Vec3> vertices = is_binary_stl(text) ? read_binary_stl(text) : read_text(text, path);
  if (vertices.empty()) fail(path, "is no mesh", "no vertices", "STL (text or binary), VTK (text)");
  for (const Vec3& p : vertices)
    if (!std::isfinite(p[0] + p[1] + p[2])) fail(path, "a vertex of the mesh is not finite");
  return vertices;
}

}  // namespace granulaw::deck
