#pragma once

#include <array>
#include <cmath>

namespace granulaw {

using Vector = std::array<double, 3>;

/// The product v x w of two vectors of any kind, such as LIGGGHTS's arrays.
template <class V, class W>
Vector cross(const V& v, const W& w)
{
  return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

inline Vector times(const Vector& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }
/// v + factor w.
inline Vector sum(const Vector& v, const Vector& w, double factor = 1.0)
{
  return {v[0] + w[0] * factor, v[1] + w[1] * factor, v[2] + w[2] * factor};
}
inline double dot(const Vector& v, const Vector& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
inline double norm(const Vector& v) { return std::sqrt(dot(v, v)); }
/// Zero of the zero vector.
inline Vector unit(const Vector& v)
{
  const double length = norm(v);
  return length > 0 ? times(v, 1.0 / length) : Vector{};
}

}  // namespace granulaw
