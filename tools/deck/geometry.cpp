#include "deck/geometry.hpp"

namespace granulaw::deck {

double ball_volume(double radius)
{
  return 4.0 / 3.0 * M_PI * radius * radius * radius;
}

void Box::include(const Vec3& p)
{
  for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
}

void Box::include(const Box& other)
{
  if (other.empty()) return;
  include(other.low);
  include(other.high);
}

Box Box::within(const Box& other) const
{
  Box result = *this;
  for (std::size_t k = 0; k < 3; ++k) {
    result.low[k] = std::max(low[k], other.low[k]);
    result.high[k] = std::min(high[k], other.high[k]);
  }
  return result;
}

double Box::volume() const
{
  return empty() ? 0.0 : size()[0] * size()[1] * size()[2];
}

std::array<Vec3, 8> Box::corners() const
{
  std::array<Vec3, 8> result;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t k = 0; k < 3; ++k) result[c][k] = (c >> k & 1) != 0 ? high[k] : low[k];
  return result;
}

double Box::top(const Vec3& axis) const
{
  double sum = 0;  // side by side: 0 times an infinite side is 0
  for (std::size_t k = 0; k < 3; ++k)
    if (axis[k] != 0) sum += axis[k] * (axis[k] > 0 ? high[k] : low[k]);
  return sum;
}

double Box::bottom(const Vec3& axis) const
{
  return -top(-1.0 * axis);
}

Vec3 rotated(const Vec3& p, const Vec3& axis, double degrees)
{
  const double length = norm(axis);
  if (length == 0) return p;
  const Vec3 k = 1 / length * axis;
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  const Vec3 cross{k[1] * p[2] - k[2] * p[1], k[2] * p[0] - k[0] * p[2], k[0] * p[1] - k[1] * p[0]};
  return c * p + s * cross + dot(k, p) * (1 - c) * k;  // Rodrigues
}

}  // namespace granulaw::deck
