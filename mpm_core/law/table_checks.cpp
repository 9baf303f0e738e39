#include "law/table_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "contact/cubic.hpp"

namespace granulaw {

void check_values(const std::vector<double>& values, std::size_t count, double low, double high,
                  const std::string& where, const std::string& name)
{
  if (values.size() != count)
    fail(where, fmt::format("'{}' has the wrong length", name), std::to_string(values.size()),
         std::to_string(count));
  for (std::size_t k = 0; k < count; ++k)
    if (!(values[k] >= low && values[k] <= high))  // NaN fails as well
      fail(where, fmt::format("'{}' at node {} is out of range", name, k), fmt::format("{:.6g}", values[k]),
           fmt::format("{:.6g} to {:.6g}", low, high));
}

void check_between(const double (&c)[4], double low, double high, const std::string& where,
                   const std::string& name, std::size_t node)
{
  // c1 + 2 c2 t + 3 c3 t^2 = 0, with q so that neither root cancels
  const double root = c[2] * c[2] - 3.0 * c[1] * c[3];
  if (!(root >= 0)) return;
  const double q = -(c[2] + std::copysign(std::sqrt(root), c[2]));
  const double fractions[2][2] = {{q, 3.0 * c[3]}, {c[1], q}};
  for (const auto& [above, below] : fractions) {
    if (below == 0) continue;  // a root at infinity
    const double t = above / below;
    if (!(t > 0 && t < 1)) continue;
    if (const double value = cubic(c, t); !(value >= low && value <= high))
      fail(where, fmt::format("'{}' between nodes {} and {} is out of range", name, node, node + 1),
           fmt::format("{:.6g}", value), fmt::format("{:.6g} to {:.6g}", low, high));
  }
}

}  // namespace granulaw
