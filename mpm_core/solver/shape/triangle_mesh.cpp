#include "solver/shape/triangle_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <map>
#include <numeric>

#include "base/error.hpp"
#include "base/stl_file.hpp"

namespace granulaw {

namespace {

std::string text(const Vector3& p)
{
  return fmt::format("({:g}, {:g}, {:g}) m", p.x(), p.y(), p.z());
}

using Edge = std::pair<int, int>;

/// How often each edge is passed from its first to its second vertex.
std::map<Edge, int> passes_of_edges(const TriangleMesh& mesh)
{
  std::map<Edge, int> passes;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++passes[{t[k], t[(k + 1) % 3]}];
  return passes;
}

void check_edges(const TriangleMesh& mesh, const std::string& where)
{
  const std::map<Edge, int> passes = passes_of_edges(mesh);
  const auto count = [&](const Edge& edge) {
    const auto found = passes.find(edge);
    return found == passes.end() ? 0 : found->second;
  };
  const auto place = [&](const Edge& edge) {
    return fmt::format("the edge from {} to {}", text(mesh.vertices[edge.first]),
                       text(mesh.vertices[edge.second]));
  };
  for (const auto& [edge, forward] : passes) {
    const int back = count({edge.second, edge.first});
    if (forward + back == 1)
      fail(where, "the mesh is not closed: an edge belongs to one triangle only", place(edge),
           "two triangles at every edge");
    if (forward + back > 2)
      fail(where, "the mesh encloses no body: an edge belongs to more than two triangles",
           fmt::format("{} at {}", forward + back, place(edge)), "two triangles at every edge");
    if (forward == 2)
      fail(where, "two neighbouring triangles of the mesh are wound in opposite senses", place(edge),
           "corners counter-clockwise seen from outside");
  }
}

void check_one_piece(const TriangleMesh& mesh, const std::string& where)
{
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) parent[root(t[1])] = parent[root(t[2])] = root(t[0]);
  for (const auto& t : mesh.triangles)
    if (root(t[0]) != root(mesh.triangles.front()[0]))
      fail(where, "the mesh has several surfaces that do not hang together",
           fmt::format("a second one at {}", text(mesh.vertices[t[0]])), "one closed surface");
}

}  // namespace

TriangleMesh read_triangle_mesh(const std::string& path, double scale)
{
  const std::vector<std::array<double, 3>> corners = stl_corners(read_mesh_bytes(path), path);
  if (corners.empty()) fail(path, "is no mesh", "no triangles", "STL, text or binary");
  if (corners.size() % 3 != 0)
    fail(path, "the mesh is damaged: three corners make a triangle",
         fmt::format("{} corners", corners.size()));
  TriangleMesh mesh;
  std::map<std::array<double, 3>, int> known;
  const auto vertex = [&](const std::array<double, 3>& p) {
    const Vector3 x = scale * Vector3(p[0], p[1], p[2]);
    if (!x.allFinite()) fail(path, "a vertex of the mesh is not finite");
    const auto [entry, is_new] = known.emplace(p, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(x);
    return entry->second;
  };
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const std::array<int, 3> t{vertex(corners[k]), vertex(corners[k + 1]), vertex(corners[k + 2])};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
  }
  return mesh;
}

void check_closed(const TriangleMesh& mesh, const std::string& where)
{
  if (mesh.triangles.size() < 4)
    fail(where, "the mesh encloses no body", fmt::format("{} triangles", mesh.triangles.size()), "4 or more");
  check_edges(mesh, where);
  check_one_piece(mesh, where);
  const double volume = mass_properties_of(mesh).volume;
  if (volume < 0)
    fail(where, "the mesh is inside out: its triangles are wound clockwise seen from outside",
         fmt::format("a volume of {:g} m^3", volume), "corners counter-clockwise seen from outside");
  if (!(volume > 0)) fail(where, "the mesh encloses no volume");
}

MassProperties mass_properties_of(const TriangleMesh& mesh)
{
  // Of a tetrahedron of the origin and a, b, c: the integral of x x^t is V/20 (s s^t + a a^t + b b^t + c
  // c^t), s = a + b + c.
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& t : mesh.triangles) {
    const Vector3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double part = a.dot(b.cross(c)) / 6;
    const Vector3 sum = a + b + c;
    volume += part;
    first += part / 4 * sum;
    second += part / 20 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  const Vector3 centre = first / volume;
  second -= volume * centre * centre.transpose();
  return {volume, centre, second.trace() * Eigen::Matrix3d::Identity() - second};
}

}  // namespace granulaw
