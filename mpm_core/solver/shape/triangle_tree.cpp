#include "solver/shape/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost 1.74's own headers include some
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <limits>
#include <map>

namespace granulaw {

namespace {

namespace bg = boost::geometry;
using Place = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Place>;
using Entry = std::pair<Box, int>;  // of a triangle

Place place(const Vector3& x)
{
  return {x.x(), x.y(), x.z()};
}

/// A triangle with the normals of its face, its edges (k: from corner k to k + 1) and its corners.
struct Facet
{
  std::array<Vector3, 3> corner;
  Vector3 face;
  std::array<Vector3, 3> edge, vertex;
};

struct FacetPoint
{
  Vector3 point;
  const Vector3* normal;
};

/// Nearest point of the triangle, and the part of the triangle it lies on (Ericson 2005, section 5.1.5).
FacetPoint nearest_point(const Facet& f, const Vector3& x)
{
  const Vector3 &a = f.corner[0], &b = f.corner[1], &c = f.corner[2];
  const Vector3 ab = b - a, ac = c - a;
  const double d1 = ab.dot(x - a), d2 = ac.dot(x - a);
  if (d1 <= 0 && d2 <= 0) return {a, &f.vertex[0]};
  const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
  if (d3 >= 0 && d4 <= d3) return {b, &f.vertex[1]};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, &f.edge[0]};
  const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
  if (d6 >= 0 && d5 <= d6) return {c, &f.vertex[2]};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, &f.edge[2]};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), &f.edge[1]};
  return {a + (vb * ab + vc * ac) / (va + vb + vc), &f.face};
}

double distance2(const Box& box, const Vector3& x)
{
  return bg::comparable_distance(place(x), box);
}

}  // namespace

struct TriangleTree::Parts
{
  std::vector<Facet> facets;
  std::vector<Vector3> vertex_normals;
  bg::index::rtree<Entry, bg::index::rstar<8>> tree;
};

namespace {

std::vector<Vector3> face_normals(const TriangleMesh& mesh)
{
  std::vector<Vector3> normals;
  for (const auto& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[t[0]];
    normals.push_back((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized());
  }
  return normals;
}

std::vector<Vector3> angle_weighted_normals(const TriangleMesh& mesh, const std::vector<Vector3>& faces)
{
  std::vector<Vector3> normals(mesh.vertices.size(), Vector3::Zero());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const auto& t = mesh.triangles[n];
      const Vector3 &p = mesh.vertices[t[k]], q = mesh.vertices[t[(k + 1) % 3]] - p,
                    r = mesh.vertices[t[(k + 2) % 3]] - p;
      normals[t[k]] += std::atan2(q.cross(r).norm(), q.dot(r)) * faces[n];
    }
  for (Vector3& n : normals) n.normalize();
  return normals;
}

std::vector<Facet> facets_of(const TriangleMesh& mesh, const std::vector<Vector3>& faces,
                             const std::vector<Vector3>& vertices)
{
  std::map<std::pair<int, int>, Vector3> of_edge;
  const auto edge = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (std::size_t n = 0; n < faces.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const auto& t = mesh.triangles[n];
      of_edge.try_emplace(edge(t[k], t[(k + 1) % 3]), Vector3::Zero()).first->second += faces[n];
    }
  std::vector<Facet> facets(faces.size());
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const auto& t = mesh.triangles[n];
    facets[n].face = faces[n];
    for (int k = 0; k < 3; ++k) {
      facets[n].corner[k] = mesh.vertices[t[k]];
      facets[n].edge[k] = of_edge.at(edge(t[k], t[(k + 1) % 3])).normalized();
      facets[n].vertex[k] = vertices[t[k]];
    }
  }
  return facets;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh)
{
  Parts parts;
  const std::vector<Vector3> faces = face_normals(mesh);
  parts.vertex_normals = angle_weighted_normals(mesh, faces);
  parts.facets = facets_of(mesh, faces, parts.vertex_normals);
  std::vector<Entry> entries;
  for (std::size_t n = 0; n < parts.facets.size(); ++n) {
    const auto& [a, b, c] = parts.facets[n].corner;
    entries.emplace_back(Box(place(a.cwiseMin(b).cwiseMin(c)), place(a.cwiseMax(b).cwiseMax(c))),
                         static_cast<int>(n));
  }
  parts.tree = {entries.begin(), entries.end()};
  parts_ = std::make_unique<const Parts>(std::move(parts));
}

TriangleTree::~TriangleTree() = default;

const std::vector<Vector3>& TriangleTree::vertex_normals() const
{
  return parts_->vertex_normals;
}

TriangleTree::Nearest TriangleTree::nearest(const Vector3& x) const
{
  // The triangle of the nearest box bounds the distance; then all whose boxes reach into the cube of that
  // size.
  const std::vector<Facet>& facets = parts_->facets;
  FacetPoint best{};
  double least = std::numeric_limits<double>::infinity();
  const auto improve = [&](const Entry& entry) {
    if (distance2(entry.first, x) > least) return;
    const FacetPoint candidate = nearest_point(facets[entry.second], x);
    const double d2 = (candidate.point - x).squaredNorm();
    if (d2 < least) least = d2, best = candidate;
  };
  const auto visit = boost::make_function_output_iterator(improve);
  parts_->tree.query(bg::index::nearest(place(x), 1), visit);
  const Vector3 reach = Vector3::Constant(std::sqrt(least));
  parts_->tree.query(bg::index::intersects(Box(place(x - reach), place(x + reach))), visit);
  const double side = (x - best.point).dot(*best.normal);
  return {side <= 0 ? std::sqrt(least) : -std::sqrt(least), best.point, *best.normal};
}

}  // namespace granulaw
