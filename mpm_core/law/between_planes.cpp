#include "law/between_planes.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

BetweenPlanes::BetweenPlanes(const PlasticBody& body, const std::vector<Vector>& normals, std::span<const double> overlaps) : body_(&body)
{
  for (std::size_t i = 0; i < normals.size(); ++i) {
    particle_.insert(static_cast<std::int64_t>(i), normals[i], overlaps[i]);
    steps_.push_back({normals[i], 0.0});
  }
  forces_.assign(normals.size(), 0.0), areas_ = stiffness_ = forces_;
}

/// The way of the centre by which elastic sides would balance: shift_ of the next step.
void BetweenPlanes::balance()
{
  std::array<Vector, 3> k{};
  Vector push{};
  double largest = 0;
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    if (!(forces_[i] > 0)) continue;
    const Vector& n = steps_[i].normal;
    push = sum(push, n, -forces_[i]);
    for (std::size_t a = 0; a < 3; ++a) k[a] = sum(k[a], n, stiffness_[i] * n[a]);
    largest = std::max(largest, stiffness_[i]);
  }
  shift_ = {};
  if (!(largest > 0)) return;
  for (std::size_t a = 0; a < 3; ++a) k[a][a] += 1e-3 * largest;  // no plane may stand across
  const Vector c = cross(k[1], k[2]);
  const double det = dot(k[0], c);
  const Vector way = times(sum(sum(times(c, push[0]), cross(k[2], k[0]), push[1]), cross(k[0], k[1]), push[2]), 1.0 / det);
  shift_ = norm(way) > longest_step ? times(way, longest_step / norm(way)) : way;
}

void BetweenPlanes::move(std::span<const double> ways)
{
  double way = 0;
  for (const double w : ways) way = std::max(way, std::abs(w));
  const int count = std::max(1, static_cast<int>(std::ceil(way / longest_step)));
  for (int k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < steps_.size(); ++i) steps_[i].advance = ways[i] / count + dot(steps_[i].normal, shift_);
    centre_ = sum(centre_, shift_);
    const std::span<const SideAnswer> now = particle_.advance(*body_, steps_, room_);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      work_ += 0.5 * (forces_[i] + now[i].force) * ways[i] / count;
      forces_[i] = now[i].force, areas_[i] = now[i].area, stiffness_[i] = std::max(now[i].stiffness, 1e-6);
    }
    balance();
  }
}

}  // namespace granulaw
