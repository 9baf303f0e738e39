#include "solver/shape/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"

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

}  // namespace

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

}  // namespace granulaw
