#include "solver/shape/mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "base/stl_file.hpp"
#include "linear/linear.hpp"
#include "solver/shape/box_tree.hpp"
#include "solver/shape/curvature.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

std::string text(const Vector3& p)
{
  return fmt::format("({:g}, {:g}, {:g}) m", p.x(), p.y(), p.z());
}

using Edge = std::pair<int, int>;

/// Number of times that each edge is passed from its first to its second vertex.
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
  // Tetrahedron of the origin and a, b, c: the integral of x x^t is V/20 (s s^t + a a^t + b b^t + c
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
  return mass_of_moments(volume, first, second);
}

namespace {

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

/// Signed distance to a closed triangle mesh. The side is that of the angle-weighted normal of the nearest
/// face, edge or vertex (Baerentzen and Aanaes 2005), which is exact.
class Facets
{
 public:
  explicit Facets(const TriangleMesh& mesh)
  {
    const std::vector<Vector3> faces = face_normals(mesh);
    vertex_normals_ = angle_weighted_normals(mesh, faces);
    facets_ = facets_of(mesh, faces, vertex_normals_);
    std::vector<BoxTree::Box> boxes;
    for (const Facet& facet : facets_) {
      const auto& [a, b, c] = facet.corner;
      boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    }
    tree_ = BoxTree(boxes, false);
  }

  struct Nearest
  {
    double depth;    ///< m, positive inside
    Vector3 point;   ///< of the surface
    Vector3 normal;  ///< outward normal of that point's face, edge or vertex; of length 1
  };
  Nearest nearest(const Vector3& x) const
  {
    FacetPoint best{};
    double least = std::numeric_limits<double>::infinity();
    tree_.search(x, least, [&](int facet) {
      const FacetPoint candidate = nearest_point(facets_[facet], x);
      const double d2 = (candidate.point - x).squaredNorm();
      if (d2 < least) least = d2, best = candidate;
    });
    const double side = (x - best.point).dot(*best.normal);
    return {side <= 0 ? std::sqrt(least) : -std::sqrt(least), best.point, *best.normal};
  }
  /// Angle-weighted mean normals of the vertices, of length 1.
  const std::vector<Vector3>& vertex_normals() const { return vertex_normals_; }

 private:
  std::vector<Facet> facets_;
  std::vector<Vector3> vertex_normals_;
  BoxTree tree_;
};

constexpr std::size_t terms_of_paraboloid = 6;

/// Height below the tangent plane, by least squares: c + g.s + s.C s/2 in the tangential coordinates s.
PrincipalRadii fit_paraboloid(const std::vector<Vector3>& points, const Vector3& origin,
                              const Vector3& normal)
{
  const Eigen::Matrix<double, 3, 2> frame = tangents(normal);
  Eigen::MatrixXd terms(points.size(), terms_of_paraboloid);
  Eigen::VectorXd height(points.size());
  double size = 0;
  for (const Vector3& p : points) size = std::max(size, (p - origin).norm());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector2d s = frame.transpose() * (points[k] - origin) / size;
    const auto row = static_cast<Eigen::Index>(k);
    terms.row(row) << 1, s.x(), s.y(), 0.5 * s.x() * s.x(), s.x() * s.y(), 0.5 * s.y() * s.y();
    height[row] = -normal.dot(points[k] - origin) / size;
  }
  const Eigen::VectorXd fit = least_squares(terms, height);
  Eigen::Matrix2d curvature;
  curvature << fit[3], fit[4], fit[4], fit[5];
  return radii_of_curvatures(curvature / size, frame);
}

/// The vertices that share a triangle with a vertex, and itself.
std::vector<std::set<int>> rings_of(const TriangleMesh& mesh)
{
  std::vector<std::set<int>> rings(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const int v : t) rings[v].insert(t.begin(), t.end());
  return rings;
}

double finest_radius_of(const TriangleMesh& mesh, const std::vector<Vector3>& normals)
{
  const std::vector<std::set<int>> rings = rings_of(mesh);
  double finest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    std::set<int> both;
    for (const int neighbour : rings[v]) both.insert(rings[neighbour].begin(), rings[neighbour].end());
    if (both.size() < terms_of_paraboloid) continue;
    std::vector<Vector3> points;
    for (const int w : both) points.push_back(mesh.vertices[w]);
    const double radius = fit_paraboloid(points, mesh.vertices[v], normals[v]).sharper;
    if (radius > 0) finest = std::min(finest, radius);
  }
  return finest;
}

/// The body inside a closed triangle mesh.
class Mesh : public Shape
{
 public:
  explicit Mesh(TriangleMesh mesh) : mesh_(std::move(mesh)), facets_(mesh_), mass_(mass_properties_of(mesh_))
  {
    patch_ = 0.1 * std::cbrt(mass_.volume * 3 / (4 * std::numbers::pi));
    finest_ = finest_radius_of(mesh_, facets_.vertex_normals());
  }

  /// The distance itself, everywhere.
  double depth(const Vector3& x) const override { return facets_.nearest(x).depth; }
  Vector3 outward_normal(const Vector3& x) const override
  {
    const Facets::Nearest nearest = facets_.nearest(x);
    const Vector3 to_surface = nearest.point - x;
    // On the surface there is no way to it.
    if (std::abs(nearest.depth) < 1e-12 * patch_) return nearest.normal;
    return to_surface / nearest.depth;
  }
  double support(const Vector3& direction, Vector3* where) const override
  {
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vector3& v : mesh_.vertices) {
      const double candidate = direction.dot(v);
      if (candidate <= reach) continue;
      reach = candidate;
      if (where) *where = v;
    }
    return reach;
  }
  /// Radii of a paraboloid fitted to the vertices within a tenth of the radius of the sphere of its volume
  /// about the support point: the curvature that a contact of about that size has. Wider where fewer than 12
  /// vertices lie there; 0 and 0 of a mesh with fewer than 6 around the point.
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    constexpr std::size_t needed = 2 * terms_of_paraboloid;
    Vector3 where;
    support(direction, &where);
    std::vector<std::pair<double, std::size_t>> around;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      if (facets_.vertex_normals()[v].dot(direction) > 0)  // not the far side of a thin body
        around.emplace_back((mesh_.vertices[v] - where).norm(), v);
    if (around.size() < terms_of_paraboloid) return {0, 0, direction.unitOrthogonal()};
    std::sort(around.begin(), around.end());
    const double reach = std::max(patch_, around[std::min(needed, around.size()) - 1].first);
    std::vector<Vector3> points;
    for (const auto& [distance, v] : around)
      if (distance <= reach) points.push_back(mesh_.vertices[v]);
    return fit_paraboloid(points, where, direction);
  }
  /// Radii of paraboloids fitted to two rings of neighbours of each vertex: at a sharp edge about the size of
  /// its triangles.
  double finest_radius() const override { return finest_; }
  MassProperties mass_properties() const override { return mass_; }
  const char* kind() const override { return "mesh"; }
  std::string definition() const override
  {
    std::string text = kind();
    for (const Vector3& v : mesh_.vertices) text += fmt::format(" {},{},{}", v.x(), v.y(), v.z());
    for (const auto& t : mesh_.triangles) text += fmt::format(" {},{},{}", t[0], t[1], t[2]);
    return text;
  }

 private:
  TriangleMesh mesh_;
  Facets facets_;
  MassProperties mass_;
  double patch_, finest_;
};

}  // namespace

SharedShape mesh_shape(TriangleMesh mesh, const std::string& where)
{
  check_closed(mesh, where);
  return std::make_shared<Mesh>(std::move(mesh));
}

ShapeKind mesh_kind()
{
  return {"mesh", {ShapeKey::file(), ShapeKey::scale()}, [](const ShapeValues& v) {
            return mesh_shape(read_triangle_mesh(v.path, v.scale()), v.path);
          }};
}

}  // namespace granulaw
