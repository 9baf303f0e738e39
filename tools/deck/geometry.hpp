#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granulaw::deck {

using Vec3 = std::array<double, 3>;

inline Vec3 operator+(const Vec3& a, const Vec3& b)
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator*(double s, const Vec3& a)
{
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vec3& a, const Vec3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Vec3& a)
{
  return std::sqrt(dot(a, a));
}

/// Volume of a sphere.
double ball_volume(double radius);

/// A box with edges along the axes; as made it is empty. Sides may be infinite.
struct Box
{
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  bool empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  void include(const Vec3& p);
  void include(const Box& other);
  Box within(const Box& other) const;  ///< the part of this in `other`
  Vec3 size() const { return high - low; }
  /// Largest and smallest coordinate along the unit vector `axis`.
  double top(const Vec3& axis) const;
  double bottom(const Vec3& axis) const;
};

}  // namespace granulaw::deck
