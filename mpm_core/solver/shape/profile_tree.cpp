#include "solver/shape/profile_tree.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

void ProfileTree::Box::add(const ProfilePoint& p)
{
  r0 = std::min(r0, p.r), r1 = std::max(r1, p.r);
  z0 = std::min(z0, p.z), z1 = std::max(z1, p.z);
}

void ProfileTree::Box::add(const Box& b)
{
  r0 = std::min(r0, b.r0), r1 = std::max(r1, b.r1);
  z0 = std::min(z0, b.z0), z1 = std::max(z1, b.z1);
}

double ProfileTree::Box::distance2(double r, double z) const
{
  const double dr = std::max({r0 - r, r - r1, 0.0}), dz = std::max({z0 - z, z - z1, 0.0});
  return dr * dr + dz * dz;
}

ProfileTree::ProfileTree(const std::vector<ProfilePoint>& points)
{
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const ProfilePoint a = points[k], b = points[k + 1];
    const double dr = b.r - a.r, dz = b.z - a.z;
    segments_.push_back({a.r, a.z, dr, dz, 1 / (dr * dr + dz * dz)});
  }
  const std::size_t runs = (segments_.size() + run_length - 1) / run_length;
  while (leaves_ < runs) leaves_ *= 2;
  boxes_.resize(2 * leaves_);
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    Box& box = boxes_[leaves_ + k / run_length];
    box.add(points[k]);
    box.add(points[k + 1]);
  }
  for (std::size_t n = leaves_ - 1; n >= 1; --n) {
    boxes_[n] = boxes_[2 * n];
    boxes_[n].add(boxes_[2 * n + 1]);
  }
}

void ProfileTree::search_run(std::size_t run, double r, double z, Nearest& best) const
{
  const std::size_t first = run * run_length, last = std::min(first + run_length, segments_.size());
  for (std::size_t k = first; k < last; ++k) {
    const Segment& s = segments_[k];
    const double t = std::clamp(((r - s.r) * s.dr + (z - s.z) * s.dz) * s.inverse_length2, 0.0, 1.0);
    const double er = r - s.r - t * s.dr, ez = z - s.z - t * s.dz;
    const double distance2 = er * er + ez * ez;
    if (distance2 < best.distance2) best = {k, t, distance2};
  }
}

/// Depth first, the nearer half first; a box that lies farther than the best so far is left out.
ProfileTree::Nearest ProfileTree::nearest(double r, double z) const
{
  struct Visit
  {
    std::size_t node;
    double least;
  } stack[64];
  int top = 0;
  stack[top++] = {1, 0};
  Nearest best{0, 0, infinity};
  while (top > 0) {
    const Visit visit = stack[--top];
    if (visit.least >= best.distance2) continue;
    if (visit.node >= leaves_) {
      search_run(visit.node - leaves_, r, z, best);
      continue;
    }
    Visit near{2 * visit.node, boxes_[2 * visit.node].distance2(r, z)};
    Visit far{near.node + 1, boxes_[near.node + 1].distance2(r, z)};
    if (far.least < near.least) std::swap(near, far);
    stack[top++] = far;
    stack[top++] = near;
  }
  return best;
}

/// At point k. There neither neighbour alone tells the side; the sum of their unit normals does. On the axis
/// the neighbour is the mirror image.
ProfilePoint ProfileTree::corner_normal(std::size_t k) const
{
  if (k == 0) return {0, 1};
  if (k == segments_.size()) return {0, -1};
  ProfilePoint normal{0, 0};
  for (const Segment& s : {segments_[k - 1], segments_[k]}) {
    const double scale = std::sqrt(s.inverse_length2);
    normal.r -= scale * s.dz;
    normal.z += scale * s.dr;
  }
  return normal;
}

ProfilePoint ProfileTree::normal_at(const Nearest& point) const
{
  if (point.t == 0) return corner_normal(point.segment);
  if (point.t == 1) return corner_normal(point.segment + 1);
  const Segment& s = segments_[point.segment];
  return {-s.dz, s.dr};
}

double ProfileTree::depth(double r, double z) const
{
  if (segments_.empty()) return -infinity;
  const Nearest point = nearest(r, z);
  const Segment& s = segments_[point.segment];
  const double er = r - s.r - point.t * s.dr, ez = z - s.z - point.t * s.dz;
  const ProfilePoint inward = normal_at(point);
  return std::copysign(std::sqrt(point.distance2), inward.r * er + inward.z * ez);
}

}  // namespace granulaw
