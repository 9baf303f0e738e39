#include "liggghts_plugin/plan/mesh_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace granulaw::plugin::plan {

namespace {

using Point = Box::Point;

constexpr std::size_t none = static_cast<std::size_t>(-1);
constexpr double rounding = 1e-9;  // of a cosine of two unit vectors

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return std::sqrt(inner(a, a)); }
Point unit_vector(const Point& a)
{
  const double own = length(a);
  return own > 0 ? Point{a[0] / own, a[1] / own, a[2] / own} : Point{};
}
Point across(const Point& a, const Point& along)
{
  const double part = inner(a, along);
  return {a[0] - part * along[0], a[1] - part * along[1], a[2] - part * along[2]};
}
Point normal_of(const MeshMotion::Triangle& t)
{
  const Point a = difference(t[1], t[0]), b = difference(t[2], t[0]);
  return unit_vector({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
}

}  // namespace

void MeshMotion::connect(const std::vector<Triangle>& corners)
{
  Box box;
  for (const Triangle& t : corners)
    for (const Point& p : t) box.include(p);
  const double grain = 1e-6 * std::max(length(box.size()), 1e-300);  // corners of one point may differ by rounding
  std::map<std::array<std::int64_t, 3>, std::size_t> known;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edge_of;
  vertices_.clear(), edges_.clear(), lowest_.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto& vertices = vertices_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<std::int64_t, 3> place;
      for (std::size_t c = 0; c < 3; ++c) place[c] = std::llround((corners[i][k][c] - box.low[c]) / grain);
      vertices[k] = known.try_emplace(place, known.size()).first->second;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, is_new] = edge_of.try_emplace(std::minmax(vertices[k], vertices[(k + 1) % 3]), edges_.size());
      if (is_new) edges_.push_back({i, k, none});
      else edges_[found->second].b = i;
    }
  }
  vertex_count_ = known.size();
}

void MeshMotion::look(const std::vector<Triangle>& corners, const std::vector<Triangle>& velocities, const Point& upward)
{
  if (vertices_.size() != corners.size()) connect(corners);
  follow_rise(corners, upward);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point n = normal_of(corners[i]);
    const double level = length(across(n, upward));
    for (const Point& v : velocities[i]) {
      const double push = std::abs(inner(v, n));
      speed_ = std::max(speed_, length(v)), push_ = std::max(push_, push), level_ = std::max(level_, level * push);
    }
  }
  if (push_ >= speed_) return;
  look_at_edges(corners, velocities);
  look_at_vertices(corners, velocities);
}

/// A sphere ahead of an edge touches it, and neither triangle, if both lie behind.
void MeshMotion::look_at_edges(const std::vector<Triangle>& corners, const std::vector<Triangle>& velocities)
{
  for (const Edge& edge : edges_) {
    const Triangle& a = corners[edge.a];
    const Point& from = a[edge.corner];
    const Point along = unit_vector(difference(a[(edge.corner + 1) % 3], from));
    const auto lies_behind = [&](std::size_t triangle, const Point& ahead) {
      if (triangle == none) return true;
      return std::all_of(corners[triangle].begin(), corners[triangle].end(), [&](const Point& p) {
        return inner(unit_vector(across(difference(p, from), along)), ahead) <= rounding;
      });
    };
    for (const std::size_t end : {edge.corner, (edge.corner + 1) % 3}) {
      const Point motion = across(velocities[edge.a][end], along);
      if (length(motion) <= push_) continue;
      const Point ahead = unit_vector(motion);
      if (lies_behind(edge.a, ahead) && lies_behind(edge.b, ahead)) push_ = length(motion);
    }
  }
}

/// Likewise a corner with all of its edges behind.
void MeshMotion::look_at_vertices(const std::vector<Triangle>& corners, const std::vector<Triangle>& velocities)
{
  std::vector<double> speeds(vertex_count_);  // 0: an edge lies ahead
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) speeds[vertices_[i][k]] = length(velocities[i][k]);
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point ahead = unit_vector(velocities[i][k]);
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
        if (inner(unit_vector(difference(corners[i][other], corners[i][k])), ahead) > rounding) speeds[vertices_[i][k]] = 0;
    }
  for (const double speed : speeds) push_ = std::max(push_, speed);
}

void MeshMotion::follow_rise(const std::vector<Triangle>& corners, const Point& upward)
{
  if (lowest_.size() != corners.size()) lowest_.assign(corners.size(), {Box::infinity, Box::infinity, Box::infinity});
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double height = inner(corners[i][k], upward);
      lowest_[i][k] = std::min(lowest_[i][k], height);
      lift_ = std::max(lift_, height - lowest_[i][k]);
    }
}

}  // namespace granulaw::plugin::plan
