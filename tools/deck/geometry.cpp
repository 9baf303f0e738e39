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

}  // namespace granulaw::deck
