#include "solver/shape/mesh_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/error.hpp"
#include "solver/shape/implicit_curvature.hpp"
#include "solver/shape/triangle_tree.hpp"

namespace granulaw {

namespace {

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
  const Eigen::VectorXd fit = terms.colPivHouseholderQr().solve(height);
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

}  // namespace

MeshSolid::MeshSolid(TriangleMesh mesh, const std::string& where) : mesh_(std::move(mesh))
{
  check_closed(mesh_, where);
  tree_ = std::make_shared<const TriangleTree>(mesh_);
  mass_ = mass_properties_of(mesh_);
  patch_ = 0.1 * std::cbrt(mass_.volume * 3 / (4 * std::numbers::pi));
  finest_ = finest_radius_of(mesh_, tree_->vertex_normals());
}

double MeshSolid::depth(const Vector3& x) const
{
  return tree_->nearest(x).depth;
}

Vector3 MeshSolid::outward_normal(const Vector3& x) const
{
  const TriangleTree::Nearest nearest = tree_->nearest(x);
  const Vector3 to_surface = nearest.point - x;
  // On the surface there is no way to it.
  if (std::abs(nearest.depth) < 1e-12 * patch_) return nearest.normal;
  return to_surface / nearest.depth;
}

double MeshSolid::support(const Vector3& direction, Vector3* where) const
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

PrincipalRadii MeshSolid::principal_radii(const Vector3& direction) const
{
  constexpr std::size_t needed = 2 * terms_of_paraboloid;
  Vector3 where;
  support(direction, &where);
  std::vector<std::pair<double, std::size_t>> around;
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
    if (tree_->vertex_normals()[v].dot(direction) > 0)  // not the far side of a thin body
      around.emplace_back((mesh_.vertices[v] - where).norm(), v);
  if (around.size() < terms_of_paraboloid) return {0, 0, direction.unitOrthogonal()};
  std::sort(around.begin(), around.end());
  const double reach = std::max(patch_, around[std::min(needed, around.size()) - 1].first);
  std::vector<Vector3> points;
  for (const auto& [distance, v] : around)
    if (distance <= reach) points.push_back(mesh_.vertices[v]);
  return fit_paraboloid(points, where, direction);
}

std::string MeshSolid::definition() const
{
  std::string text = kind();
  for (const Vector3& v : mesh_.vertices) text += fmt::format(" {},{},{}", v.x(), v.y(), v.z());
  for (const auto& t : mesh_.triangles) text += fmt::format(" {},{},{}", t[0], t[1], t[2]);
  return text;
}

}  // namespace granulaw
