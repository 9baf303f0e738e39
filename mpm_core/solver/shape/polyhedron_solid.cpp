#include "solver/shape/polyhedron_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/shape/convex_hull.hpp"

namespace granulaw {

namespace {

/// The support points of directions along `rows` parallels and two poles.
TriangleMesh mesh_of_support_points(const Solid& solid, int rows)
{
  const int columns = 2 * rows;
  TriangleMesh mesh;
  const auto add = [&](double theta, double phi) {
    const Vector3 direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                            std::cos(theta));
    solid.support(direction, &mesh.vertices.emplace_back());
  };
  for (int i = 1; i <= rows; ++i)
    for (int j = 0; j < columns; ++j)
      add(std::numbers::pi * i / (rows + 1), 2 * std::numbers::pi * j / columns);
  const int top = rows * columns, bottom = top + 1;
  add(0, 0);
  add(std::numbers::pi, 0);
  const auto at = [&](int i, int j) { return i * columns + j % columns; };
  for (int j = 0; j < columns; ++j) {
    mesh.triangles.push_back({top, at(0, j), at(0, j + 1)});
    mesh.triangles.push_back({bottom, at(rows - 1, j + 1), at(rows - 1, j)});
    for (int i = 0; i + 1 < rows; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace

PolyhedronSolid::PolyhedronSolid(const std::vector<Vector3>& corners, double edge_radius,
                                 const std::string& where)
    : hull_(convex_hull(corners, where), where), edge_radius_(edge_radius)
{
}

double PolyhedronSolid::support(const Vector3& direction, Vector3* where) const
{
  const double reach = hull_.support(direction, where);
  if (where) *where += edge_radius_ * direction;
  return reach + edge_radius_;
}

PrincipalRadii PolyhedronSolid::principal_radii(const Vector3& direction) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Vector3>& corners = hull_.mesh().vertices;
  Vector3 low, high;
  hull_.bounds(low, high);
  const double near = 1e-9 * (high - low).norm(), reach = hull_.support(direction, nullptr);
  std::vector<Vector3> touching;
  for (const Vector3& corner : corners)
    if (reach - direction.dot(corner) <= near) touching.push_back(corner);
  if (touching.size() == 1) return {edge_radius_, edge_radius_, direction.unitOrthogonal()};
  if (touching.size() > 2) return {infinity, infinity, direction.unitOrthogonal()};
  return {edge_radius_, infinity, (touching[1] - touching[0]).cross(direction).normalized()};
}

MassProperties PolyhedronSolid::mass_properties() const
{
  return mass_properties_of(mesh_of_support_points(*this, 256));
}

std::string PolyhedronSolid::definition() const
{
  return fmt::format("polyhedron {} {}", edge_radius_, hull_.definition());
}

}  // namespace granulaw
