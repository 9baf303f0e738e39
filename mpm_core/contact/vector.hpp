#pragma once

#include <array>

namespace granulaw {

using Vector = std::array<double, 3>;

/// The product v x w of two vectors of any kind, such as LIGGGHTS's arrays.
template <class V, class W>
Vector cross(const V& v, const W& w)
{
  return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
}

}  // namespace granulaw
