#include "solver/solid/mesh_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "solver/solid/implicit_curvature.hpp"
#include "solver/solid/triangle_tree.hpp"

namespace granulaw {

namespace {

using std::numbers::pi;

/// Least radius of curvature over the vertices: the larger principal curvature H + sqrt(H^2 - K), where H and
/// K are the means over a third of the triangles about a vertex. The integral of H is a quarter of the edges'
/// lengths times their angles (convex: positive), that of K what the angles lack to 2 pi.
double finest_radius_of(const TriangleMesh& mesh)
{
  const std::size_t n = mesh.vertices.size();
  std::vector<double> area(n), mean(n), gauss(n, 2 * pi);
  std::map<std::pair<int, int>, Vector3> normal_beside;
  for (const auto& t : mesh.triangles) {
    const Vector3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vector3 twice = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) {
      const int v = t[k], next = t[(k + 1) % 3], last = t[(k + 2) % 3];
      const Vector3 p = mesh.vertices[next] - mesh.vertices[v], q = mesh.vertices[last] - mesh.vertices[v];
      area[v] += twice.norm() / 6;
      gauss[v] -= std::atan2(p.cross(q).norm(), p.dot(q));
      normal_beside[{v, next}] = twice.normalized();
    }
  }
  for (const auto& [edge, normal] : normal_beside) {
    const Vector3 along = mesh.vertices[edge.second] - mesh.vertices[edge.first];
    const Vector3& other = normal_beside.at({edge.second, edge.first});
    const double angle = std::atan2(normal.cross(other).dot(along.normalized()), normal.dot(other));
    mean[edge.first] += 0.25 * along.norm() * angle;
  }
  double finest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < n; ++v) {
    if (!(area[v] > 0)) continue;
    const double h = mean[v] / area[v], k = gauss[v] / area[v];
    const double sharpest = h + std::sqrt(std::max(0.0, h * h - k));
    if (sharpest > 0) finest = std::min(finest, 1 / sharpest);
  }
  return finest;
}

/// Height below the tangent plane, by least squares: c + g.s + s.C s/2 in the tangential coordinates s.
PrincipalRadii fit_paraboloid(const std::vector<Vector3>& points, const Vector3& origin,
                              const Vector3& normal)
{
  const Eigen::Matrix<double, 3, 2> frame = tangents(normal);
  Eigen::MatrixXd terms(points.size(), 6);
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

}  // namespace

MeshSolid::MeshSolid(TriangleMesh mesh, const std::string& where) : mesh_(std::move(mesh))
{
  check_closed(mesh_, where);
  tree_ = std::make_shared<const TriangleTree>(mesh_);
  mass_ = mass_properties_of(mesh_);
  patch_ = 0.2 * std::cbrt(mass_.volume * 3 / (4 * pi));
  finest_ = finest_radius_of(mesh_);
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
  constexpr std::size_t needed = 12, least = 6;
  Vector3 where;
  support(direction, &where);
  std::vector<std::pair<double, std::size_t>> around;
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
    if (tree_->vertex_normals()[v].dot(direction) > 0)  // not the far side of a thin body
      around.emplace_back((mesh_.vertices[v] - where).norm(), v);
  if (around.size() < least) return {0, 0, direction.unitOrthogonal()};
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
