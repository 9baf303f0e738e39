#include "atlas/node_slopes.hpp"

namespace granulaw {

std::vector<double> difference_slopes(const std::vector<double>& y, double h)
{
  const std::size_t count = y.size();
  std::vector<double> slope(count, 0.0);
  if (count == 2) slope.assign(2, (y[1] - y[0]) / h);
  if (count < 3) return slope;
  const std::size_t last = count - 1;
  slope[0] = (-3 * y[0] + 4 * y[1] - y[2]) / (2 * h);
  for (std::size_t k = 1; k < last; ++k) slope[k] = (y[k + 1] - y[k - 1]) / (2 * h);
  slope[last] = (3 * y[last] - 4 * y[last - 1] + y[last - 2]) / (2 * h);
  return slope;
}

}  // namespace granulaw
