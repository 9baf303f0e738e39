#include "solver/shape/solid.hpp"

namespace granulaw {

void Solid::bounds(Vector3& low, Vector3& high) const
{
  for (int k = 0; k < 3; ++k) {
    high[k] = support(Vector3::Unit(k), nullptr);
    low[k] = -support(-Vector3::Unit(k), nullptr);
  }
}

}  // namespace granulaw
