#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

constexpr double rounding = 1e-9;  // of the size: points as near to a plane lie in it

double size_of(const std::vector<Vector3>& points)
{
  double size = 0;
  for (const Vector3& p : points) size = std::max(size, (p - points.front()).norm());
  return size;
}

/// The corners of the convex polygon that points of one plane span, counter-clockwise about the normal
/// (Andrew's monotone chain).
std::vector<int> polygon_of(const std::vector<Vector3>& points, std::vector<int> in_plane,
                            const Vector3& normal, double area_rounding)
{
  const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto along = [&](int k) { return std::pair(points[k].dot(u), points[k].dot(v)); };
  std::sort(in_plane.begin(), in_plane.end(), [&](int a, int b) { return along(a) < along(b); });
  const auto turns_left = [&](int a, int b, int c) {
    return (points[b] - points[a]).cross(points[c] - points[b]).dot(normal) > area_rounding;
  };
  std::vector<int> polygon;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t start = polygon.size();
    for (auto k = begin; k != end; ++k) {
      while (polygon.size() >= start + 2 && !turns_left(polygon.end()[-2], polygon.back(), *k))
        polygon.pop_back();
      polygon.push_back(*k);
    }
    polygon.pop_back();  // the other chain begins with it
  };
  add_chain(in_plane.begin(), in_plane.end());
  add_chain(in_plane.rbegin(), in_plane.rend());
  return polygon;
}

/// The points of the plane through three points if all others lie on its inner side; else none.
std::vector<int> face_through(const std::vector<Vector3>& points, int a, const Vector3& normal, double near)
{
  std::vector<int> in_plane;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double height = normal.dot(points[k] - points[a]);
    if (height > near) return {};
    if (height >= -near) in_plane.push_back(static_cast<int>(k));
  }
  return in_plane;
}

/// Surface of the smallest convex body that holds the points; those inside it or on its faces and edges are
/// left out. For some hundred points: the time goes with the fourth power. Throws Error "WHERE: ..." if they
/// span no volume.
TriangleMesh convex_hull(const std::vector<Vector3>& points, const std::string& where)
{
  const double size = size_of(points), near = rounding * size;
  const int n = static_cast<int>(points.size());
  std::map<std::vector<int>, Vector3> faces;  // points of a face, and its normal
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = a + 1; c < n; ++c) {  // both senses of the normal
        if (b == c) continue;
        const Vector3 across = (points[b] - points[a]).cross(points[c] - points[a]);
        if (across.norm() <= near * size) continue;
        const std::vector<int> face = face_through(points, a, across.normalized(), near);
        if (!face.empty()) faces.try_emplace(face, across.normalized());
      }
  if (faces.size() < 4) fail(where, "the corners span no volume: they lie in one plane");
  TriangleMesh mesh;
  std::map<int, int> vertex_of;
  const auto vertex = [&](int k) {
    const auto [entry, is_new] = vertex_of.try_emplace(k, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(points[k]);
    return entry->second;
  };
  for (const auto& [face, normal] : faces) {
    const std::vector<int> polygon = polygon_of(points, face, normal, near * size);
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      mesh.triangles.push_back({vertex(polygon[0]), vertex(polygon[k]), vertex(polygon[k + 1])});
  }
  return mesh;
}

/// The support points of directions along `rows` parallels and two poles.
TriangleMesh mesh_of_support_points(const Shape& shape, int rows)
{
  const int columns = 2 * rows;
  TriangleMesh mesh;
  const auto add = [&](double theta, double phi) {
    const Vector3 direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                            std::cos(theta));
    shape.support(direction, &mesh.vertices.emplace_back());
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

/// All points within `edge_radius` of the convex hull of `corners`: a convex polyhedron with rounded edges
/// and corners.
class Polyhedron : public Shape
{
 public:
  Polyhedron(const std::vector<Vector3>& corners, double edge_radius, const std::string& where)
      : edge_radius_(edge_radius)
  {
    TriangleMesh hull = convex_hull(corners, where);
    corners_ = hull.vertices;
    hull_ = mesh_shape(std::move(hull), where);
  }

  /// The distance itself.
  double depth(const Vector3& x) const override { return hull_->depth(x) + edge_radius_; }
  Vector3 outward_normal(const Vector3& x) const override { return hull_->outward_normal(x); }
  double support(const Vector3& direction, Vector3* where) const override
  {
    const double reach = hull_->support(direction, where);
    if (where) *where += edge_radius_ * direction;
    return reach + edge_radius_;
  }
  /// `edge_radius` along an edge, and both ways at a corner; directions within 1e-9 of a face's or an edge's
  /// count as its.
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    constexpr double flat = std::numeric_limits<double>::infinity();
    Vector3 low, high;
    hull_->bounds(low, high);
    const double near = 1e-9 * (high - low).norm(), reach = hull_->support(direction, nullptr);
    std::vector<Vector3> touching;
    for (const Vector3& corner : corners_)
      if (reach - direction.dot(corner) <= near) touching.push_back(corner);
    if (touching.size() == 1) return {edge_radius_, edge_radius_, direction.unitOrthogonal()};
    if (touching.size() > 2) return {flat, flat, direction.unitOrthogonal()};
    return {edge_radius_, flat, (touching[1] - touching[0]).cross(direction).normalized()};
  }
  double finest_radius() const override { return edge_radius_; }
  /// Properties of the mesh of the support points of some 1e5 directions: within 1e-4.
  MassProperties mass_properties() const override
  {
    return mass_properties_of(mesh_of_support_points(*this, 256));
  }
  const char* kind() const override { return "polyhedron"; }
  std::string definition() const override
  {
    return fmt::format("polyhedron {} {}", edge_radius_, hull_->definition());
  }

 private:
  std::vector<Vector3> corners_;  // of the hull
  SharedShape hull_;
  double edge_radius_;
};

}  // namespace

SharedShape polyhedron_shape(const std::vector<Vector3>& corners, double edge_radius,
                             const std::string& where)
{
  return std::make_shared<Polyhedron>(corners, edge_radius, where);
}

ShapeKind polyhedron_kind()
{
  const ShapeKey corners{"corners", "m", 4, 100, true, ShapeKey::Form::points, 3, "the corners of a body"};
  return {"polyhedron", {corners, ShapeKey::positive("edge_radius", "m")}, [](const ShapeValues& v) {
            return polyhedron_shape(v.points("corners"), v.number("edge_radius"), v.where("corners"));
          }};
}

}  // namespace granulaw
