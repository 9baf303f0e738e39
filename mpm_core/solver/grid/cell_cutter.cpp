#include "solver/grid/cell_cutter.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace granulaw {

CellSplines::CellSplines(const SplineAxis& axis, int cell)
{
  const std::vector<double>& t = axis.lines();
  const int last = axis.cells() - 1;
  edge = t[cell + 1] - t[cell], middle = 0.5 * (t[cell] + t[cell + 1]);
  left = edge / (t[cell + 1] - (cell > 0 ? t[cell - 1] : t[cell]));
  right = edge / ((cell < last ? t[cell + 2] : t[cell + 1]) - t[cell]);
  const double lower[3] = {0.25 * left, -left, left}, upper[3] = {0.25 * right, right, right};
  for (int m = 0; m < 3; ++m) {
    n[0][m] = lower[m], n[2][m] = upper[m];
    n[1][m] = (m == 0 ? 1.0 : 0.0) - lower[m] - upper[m];
  }
}

void Moments::add_point(const Vector3& x, double weight)
{
  const double power[3][3] = {{1, x[0], x[0] * x[0]}, {1, x[1], x[1] * x[1]}, {1, x[2], x[2] * x[2]}};
  for (int l = 0; l < 3; ++l)
    for (int m = 0; m < 3; ++m) {
      const double part = weight * power[0][l] * power[1][m];
      for (int n = 0; n < 3; ++n) value[9 * l + 3 * m + n] += part * power[2][n];
    }
}

void Moments::add_box(const Vector3& centre, const Vector3& edges)
{
  double power[3][3];
  for (int d = 0; d < 3; ++d) {
    power[d][0] = 1, power[d][1] = centre[d];
    power[d][2] = centre[d] * centre[d] + edges[d] * edges[d] / 12;
  }
  for (int k = 0; k < 27; ++k)
    value[k] += edges.prod() * power[0][k / 9] * power[1][k / 3 % 3] * power[2][k % 3];
}

double Moments::of(const double (&x)[3], const double (&y)[3], const double (&z)[3]) const
{
  double sum = 0;
  for (int k = 0; k < 27; ++k) sum += x[k / 9] * y[k / 3 % 3] * z[k % 3] * value[k];
  return sum;
}

CellCutter::CellCutter(const SpatialSection& section, const std::array<const CellSplines*, 3>& splines)
    : section_(section)
{
  for (int d = 0; d < 3; ++d) middle_[d] = splines[d]->middle, edge_[d] = splines[d]->edge;
}

int CellCutter::whole_phase() const
{
  const double depth = section_.depth(middle_), reach = 0.5 * edge_.norm();
  if (depth <= -reach) return -1;
  return depth >= reach ? phase_of_whole(middle_, reach) : -2;
}

OctantContent CellCutter::octant(int k)
{
  content_ = {};
  content_.phases.resize(section_.phases.size());
  base_ = Vector3(k & 4 ? 0 : -0.5, k & 2 ? 0 : -0.5, k & 1 ? 0 : -0.5);
  depth_.fill(std::numeric_limits<double>::quiet_NaN());
  divide({0, 0, 0}, boxes);
  return std::move(content_);
}

/// -2: an interface passes through the ball of radius `reach` about x.
int CellCutter::phase_of_whole(const Vector3& x, double reach) const
{
  if (!section_.phase_at) return 0;
  return section_.interface_distance(x) >= reach ? section_.phase_at(x) : -2;
}

Vector3 CellCutter::cell_place(const Corner& c) const
{
  return base_ + 0.5 / boxes * Vector3(c[0], c[1], c[2]);
}

double CellCutter::depth_at(const Corner& c)
{
  double& depth = depth_[(c[0] * (boxes + 1) + c[1]) * (boxes + 1) + c[2]];
  if (std::isnan(depth)) depth = section_.depth(place(cell_place(c)));
  return depth;
}

/// The box of `edge` small boxes each way from `low` on.
void CellCutter::divide(const Corner& low, int edge)
{
  const double share = 0.5 * edge / boxes;  // of the cell's edges
  const Vector3 centre = cell_place(low) + 0.5 * share * Vector3::Ones(), x = place(centre);
  const double depth = section_.depth(x), reach = 0.5 * share * edge_.norm();
  if (depth <= -reach) return;
  const int phase = depth >= reach ? phase_of_whole(x, reach) : -2;
  if (phase == -1) return;
  if (phase >= 0) return content_.phases[phase].add_box(centre, share * Vector3::Ones());
  if (edge == 1) return cut_box(low, x);
  for (int k = 0; k < octants; ++k)
    divide({low[0] + (k >> 2 & 1) * edge / 2, low[1] + (k >> 1 & 1) * edge / 2, low[2] + (k & 1) * edge / 2},
           edge / 2);
}

/// All of it goes to one phase: interfaces are followed by small boxes.
void CellCutter::cut_box(const Corner& low, const Vector3& middle)
{
  int phase = 0;
  if (section_.phase_at) {
    const double outside = std::min(0.0, section_.depth(middle));
    phase = section_.phase_at(outside < 0 ? Vector3(middle + outside * section_.normal(middle)) : middle);
  }
  if (phase < 0) return;
  int inside = 0;
  for (int k = 0; k < octants; ++k)
    inside += depth_at({low[0] + (k >> 2 & 1), low[1] + (k >> 1 & 1), low[2] + (k & 1)}) > 0 ? 1 : 0;
  if (inside == 0) return;
  if (inside == octants) {
    const Vector3 edges = Vector3::Constant(0.5 / boxes);
    return content_.phases[phase].add_box(cell_place(low) + 0.5 * edges, edges);
  }
  constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (const int(&axes)[3] : order) {  // from the lowest corner to the highest along the axes in this order
    std::array<Corner, 4> corners{low, low, low, low};
    for (int k = 0; k < 3; ++k)
      for (int later = k + 1; later < 4; ++later) ++corners[later][axes[k]];
    cut_tetrahedron(corners, content_.phases[phase]);
  }
}

void CellCutter::cut_tetrahedron(const std::array<Corner, 4>& corners, Moments& piece)
{
  std::array<Vector3, 4> x;
  std::array<double, 4> depth;
  int in = 0, out = 4;  // corners inside first
  for (const Corner& c : corners) {
    const double value = depth_at(c);
    const int at = value > 0 ? in++ : --out;
    x[at] = cell_place(c), depth[at] = value;
  }
  const auto between = [&](int a, int b) -> Vector3 {
    return x[a] + depth[a] / (depth[a] - depth[b]) * (x[b] - x[a]);
  };
  const auto add_prism = [&](const std::array<Vector3, 3>& a, const std::array<Vector3, 3>& b) {
    add_tetrahedron({a[0], a[1], a[2], b[0]}, piece);
    add_tetrahedron({a[1], a[2], b[0], b[1]}, piece);
    add_tetrahedron({a[2], b[0], b[1], b[2]}, piece);
  };
  if (in == 4) add_tetrahedron(x, piece);
  if (in == 1) {
    const std::array<Vector3, 3> facet{between(0, 1), between(0, 2), between(0, 3)};
    add_tetrahedron({x[0], facet[0], facet[1], facet[2]}, piece);
    add_facet(facet);
  }
  if (in == 2) {
    const std::array<Vector3, 3> a{x[0], between(0, 2), between(0, 3)}, b{x[1], between(1, 2), between(1, 3)};
    add_prism(a, b);
    add_facet({a[1], a[2], b[2]}), add_facet({a[1], b[2], b[1]});
  }
  if (in == 3) {
    const std::array<Vector3, 3> facet{between(0, 3), between(1, 3), between(2, 3)};
    add_prism({x[0], x[1], x[2]}, facet);
    add_facet(facet);
  }
}

/// By four points, exact to the second degree; the corners are a quarter of an octant apart.
void CellCutter::add_tetrahedron(const std::array<Vector3, 4>& x, Moments& piece) const
{
  Eigen::Matrix3d sides;
  sides << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  const double weight = std::abs(sides.determinant()) / 24;
  constexpr double off = 0.13819660112501052, near = 1 - 4 * off;
  const Vector3 sum = off * (x[0] + x[1] + x[2] + x[3]);
  for (const Vector3& corner : x) piece.add_point(sum + near * corner, weight);
}

/// By three points, exact to the second degree.
void CellCutter::add_facet(const std::array<Vector3, 3>& x)
{
  const Vector3 a = (x[1] - x[0]).cwiseProduct(edge_), b = (x[2] - x[0]).cwiseProduct(edge_);
  const double weight = a.cross(b).norm() / 6;
  const Vector3 sum = (x[0] + x[1] + x[2]) / 6;
  for (const Vector3& corner : x) content_.patch.add_point(sum + 0.5 * corner, weight);
}

}  // namespace granulaw
