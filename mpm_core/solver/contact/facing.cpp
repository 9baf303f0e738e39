#include "solver/contact/facing.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/state_archive.hpp"

namespace granulaw {

namespace {

/// Height below the middle, over that of the pole, from which on markers and corners face the other body:
/// contacts up to 0.87 of its radius.
constexpr double facing_share = 0.5;

Vector3 reference_place_of(const Markers& markers, int m)
{
  return {markers.place[m][0], markers.place[m][1], markers.place[m][2]};
}

double lowest(const Markers& markers)
{
  double z = 0;
  for (const std::array<double, 3>& place : markers.place) z = std::min(z, place[2]);
  return z;
}

/// From the second body's frame to the first one's: its outward normal from its inward one, and minus a velocity
/// from a velocity.
Vector3 mirrored(const Vector3& v)
{
  return {-v[0], -v[1], v[2]};
}

/// Number of the half cell of an axis that holds x.
int half_cell(const SplineAxis& axis, double x)
{
  const int cell = axis.cell(x);
  return 2 * cell + (x > 0.5 * (axis.lines()[cell] + axis.lines()[cell + 1]) ? 1 : 0);
}

}  // namespace

Facing::Facing(std::span<const Body> bodies, double apart, double friction)
    : apart_(apart), friction_(friction), mirrored_(bodies[1].reference().mirrored)
{
  make_corners(bodies[1]);
  make_meshes();
  const Markers& surface = bodies[0].reference().surface;
  const double least = facing_share * lowest(surface);
  const auto& axes = bodies[1].reference().cells.axes;
  for (int m = 0; m < surface.count; ++m) {
    if (surface.place[m][2] > least) continue;
    const int mesh = half_cell(axes[0], surface.place[m][0]) + along_x_ * half_cell(axes[1], surface.place[m][1]);
    facing_.push_back(m), mesh_.push_back(mesh);
  }
  for (int k = 0; k < cell_nodes; ++k) offsets_[k] = 4 * surface.offset[k];
  impulse_.assign(4 * facing_.size(), 0.0);
  far_weight_.resize(room_ * facing_.size());
}

void Facing::make_corners(const Body& far)
{
  const Markers& surface = far.reference().surface;
  const auto& axes = far.reference().cells.axes;
  along_x_ = 2 * axes[0].cells();
  corners_.resize(std::size_t(along_x_) * 2 * axes[1].cells());
  std::vector<std::map<int, double>> sums(corners_.size());
  const double least = facing_share * lowest(surface);
  for (int m = 0; m < surface.count; ++m) {
    const Vector3 x = reference_place_of(surface, m);
    if (x[2] > least) continue;
    const int at = half_cell(axes[0], x[0]) + along_x_ * half_cell(axes[1], x[1]);
    Corner& corner = corners_[at];
    corner.area += surface.area[m], corner.place += surface.area[m] * x;
    for (int k = 0; k < cell_nodes; ++k)
      sums[at][surface.node(m, k)] += surface.area[m] * surface.weights(m)[k];
  }
  for (std::size_t at = 0; at < corners_.size(); ++at) {
    Corner& corner = corners_[at];
    if (!(corner.area > 0)) continue;
    corner.place /= corner.area;
    for (const auto& [node, sum] : sums[at])
      corner.node.push_back(node), corner.weight.push_back(sum / corner.area);
  }
}

void Facing::make_meshes()
{
  meshes_.resize(corners_.size());
  const int count = static_cast<int>(corners_.size());
  for (int at = 0; at + along_x_ + 1 < count; ++at) {
    if ((at + 1) % along_x_ == 0) continue;
    std::map<int, std::array<double, 4>> weights;
    bool whole = true;
    for (int k = 0; k < 4; ++k) {
      const Corner& c = corners_[corner(at, k)];
      whole = whole && c.area > 0;
      for (std::size_t n = 0; n < c.node.size(); ++n) weights[4 * c.node[n]][k] = c.weight[n];
    }
    if (!whole) continue;
    Mesh& mesh = meshes_[at];
    for (const auto& [offset, of_corner] : weights) {
      mesh.offset.push_back(offset);
      for (int k = 0; k < 4; ++k) mesh.weight[k].push_back(of_corner[k]);
    }
    while (mesh.offset.size() % 3) {  // the kernels take three nodes at a time
      mesh.offset.push_back(mesh.offset.back());
      for (std::vector<double>& weight : mesh.weight) weight.push_back(0);
    }
    room_ = std::max(room_, mesh.offset.size());
  }
}

void Facing::move_corners(const Body& far)
{
  for (Corner& c : corners_) {
    Eigen::Vector4d u = Eigen::Vector4d::Zero(), v = u;
    for (std::size_t n = 0; n < c.node.size(); ++n) {
      u += c.weight[n] * Eigen::Map<const Eigen::Vector4d>(far.u_i.values.data() + 4 * c.node[n]);
      v += c.weight[n] * Eigen::Map<const Eigen::Vector4d>(far.v_i.values.data() + 4 * c.node[n]);
    }
    c.now = c.place + u.head<3>(), c.velocity = v.head<3>();
  }
}

/// From the mesh in `across` to the one that lies across the place, by Newton's steps: false beyond the net.
/// Where the net ends at a mirror its first corners stand for the strip before them.
bool Facing::find(const Vector3& place, Across& across) const
{
  double &s = across.s, &t = across.t;
  for (int step = 0; step < 200; ++step) {
    if (meshes_[across.mesh].offset.empty()) return false;
    const auto [now, along_s, along_t] = patch(across);
    Eigen::Matrix2d slopes;
    slopes << along_s.head<2>(), along_t.head<2>();
    const Eigen::Vector2d way = slopes.inverse() * (place - now).head<2>();
    const int column = across.mesh % along_x_, line = across.mesh / along_x_;
    const double to_s = mirrored_[0] && column == 0 ? std::max(s + way[0], 0.0) : s + way[0];
    const double to_t = mirrored_[1] && line == 0 ? std::max(t + way[1], 0.0) : t + way[1];
    const double moved = std::abs(to_s - s) + std::abs(to_t - t);
    constexpr double beyond = 1e-9;  // else rounding would send a place on an edge to and fro
    const int right = (to_s > 1 + beyond) - (to_s < -beyond), up = (to_t > 1 + beyond) - (to_t < -beyond);
    if (column + right < 0 || line + up < 0) return false;
    across = {across.mesh + right + up * along_x_, to_s - right, to_t - up};
    if (moved < 1e-6 && right == 0 && up == 0) return true;
  }
  return false;
}

Facing::Patch Facing::patch(const Across& at) const
{
  const Vector3 &low = corners_[at.mesh].now, &x = corners_[corner(at.mesh, 1)].now,
                &y = corners_[corner(at.mesh, 2)].now, &xy = corners_[corner(at.mesh, 3)].now;
  const Vector3 along_s = x - low + at.t * (xy - x - y + low), along_t = y - low + at.s * (xy - x - y + low);
  return {low + at.s * along_s + at.t * (y - low), along_s, along_t};
}

/// The nodes of the second body under a marker.
Stencil Facing::far_stencil(const Across& across, double* weight) const
{
  const Mesh& mesh = meshes_[across.mesh];
  const std::array<double, 4> share = across.weights();
  for (std::size_t n = 0; n < mesh.offset.size(); ++n) {
    weight[n] = 0;
    for (int k = 0; k < 4; ++k) weight[n] += share[k] * mesh.weight[k][n];
  }
  return {1, static_cast<int>(mesh.offset.size()), 0, mesh.offset.data(), weight};
}

int Facing::add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
                     ContactRow* rows)
{
  const Markers& surface = bodies[0].reference().surface;
  const RowKernels& kernels = row_kernels(bodies[0]);
  move_corners(bodies[1]);
  int made = 0;
  for (std::size_t f = 0; f < facing_.size(); ++f) {
    const int m = facing_[f];
    double* impulse = impulse_.data() + 4 * f;
    const Stencil near{0, cell_nodes, 4 * surface.lowest[m], offsets_.data(), surface.weights(m)};
    double u[4], v[4];
    kernels.carry(nodes[0], nodes[0].u, near, u);
    kernels.carry(nodes[0], nodes[0].v, near, v);
    const Vector3 place = reference_place_of(surface, m) + Vector3(u[0], u[1], u[2]);
    Across across{mesh_[f], 0.5, 0.5};
    if (!find(place, across)) {
      std::fill_n(impulse, 4, 0.0);
      continue;
    }
    mesh_[f] = across.mesh;
    const Patch there = patch(across);
    const Vector3 normal = mirrored(there.along_s.cross(there.along_t).normalized());
    Vector3 velocity(v[0], v[1], v[2]);
    for (int k = 0; k < 4; ++k)
      velocity += across.weights()[k] * mirrored(corners_[corner(across.mesh, k)].velocity);
    const double gap = (place[2] + there.now[2] + apart_) * normal[2], approach = normal.dot(velocity);
    const bool pushed = impulse[0] != 0 || impulse[1] != 0 || impulse[2] != 0;
    // a row for each marker that would pass, or might once its neighbours are pushed back
    if (gap + dt * approach > 0 && !pushed && gap > 4 * dt * std::abs(approach)) continue;
    ContactRow& row = rows[made];
    row = {};
    for (int d = 0; d < 3; ++d) row.normal[d] = row.along[d] = normal[d], row.of_other[d] = d == 2 ? 1 : -1;
    row.near = near, row.far = far_stencil(across, far_weight_.data() + room_ * f);
    row.impulse = impulse, row.marker = m, row.friction = friction_;
    row.needed = -(gap < 0 ? recovery : 1) * gap / dt;
    kernels.weigh(nodes, kick, row);
    made += row.response > 0 ? 1 : 0;
  }
  return made;
}

double Facing::finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double)
{
  double total = 0;
  for (const ContactRow& row : rows) total += row.impulse[2];
  return bodies[0].reference().copies() * total;
}

double Facing::edge_radius(std::span<const Body> bodies) const
{
  const Markers& surface = bodies[0].reference().surface;
  double area = 0, along = 0, square = 0;
  for (std::size_t f = 0; f < facing_.size(); ++f) {
    if (!(impulse_[4 * f + 2] > 0)) continue;
    const double a = surface.area[facing_[f]], x = surface.place[facing_[f]][0], y = surface.place[facing_[f]][1];
    area += a, along += a * x, square += a * (x * x + y * y);
  }
  if (!(area > 0)) return 0;
  const double middle = mirrored_[0] ? 0 : along / area;
  return std::sqrt(2 * (square / area - middle * middle));
}

void Facing::visit_state(StateArchive& a)
{
  a.values(impulse_), a.values(mesh_);
}

}  // namespace granulaw
