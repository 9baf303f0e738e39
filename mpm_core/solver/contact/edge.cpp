#include "solver/contact/edge.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

double edge_between(double closed, EdgePoint first, EdgePoint second)
{
  first.gap = std::max(0.0, first.gap);
  if (!(second.gap > first.gap)) return closed;
  const double q = std::cbrt((first.gap / second.gap) * (first.gap / second.gap));
  return std::clamp((first.r - q * second.r) / (1 - q), closed, std::max(closed, first.r));
}

}  // namespace granulaw
