#include "deck/mesh_file.hpp"

#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "base/stl_file.hpp"

namespace granulaw::deck {

namespace {

std::vector<Vec3> vtk_points(const std::string& text)
{
  std::vector<Vec3> points;
  std::istringstream words(text);
  std::string word;
  while (words >> word && word != "POINTS") continue;
  std::size_t n = 0;
  words >> n >> word;
  Vec3 p;
  for (std::size_t k = 0; k < n && words >> p[0] >> p[1] >> p[2]; ++k) points.push_back(p);
  return points;
}

}  // namespace

std::vector<Vec3> mesh_vertices(const std::string& path)
{
  const std::string bytes = read_mesh_bytes(path);
  std::vector<Vec3> vertices = stl_corners(bytes, path);
  if (vertices.empty()) vertices = vtk_points(bytes);
  if (vertices.empty()) fail(path, "is no mesh", "no vertices", "STL (text or binary), VTK (text)");
  for (const Vec3& p : vertices)
    if (!std::isfinite(p[0] + p[1] + p[2])) fail(path, "a vertex of the mesh is not finite");
  return vertices;
}

}  // namespace granulaw::deck
