#include "atlas/node_slopes.hpp"

#include <gtest/gtest.h>

namespace granulaw::node_slopes_test {

TEST(NodeSlopes, DifferencesAreExactForAParabola)
{
  const double h = 0.1;
  std::vector<double> values;
  for (int k = 0; k < 6; ++k) values.push_back(1 - 2 * k * h + 3 * k * h * k * h);
  const std::vector<double> slopes = difference_slopes(values, h);
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(slopes[static_cast<std::size_t>(k)], -2 + 6 * k * h, 1e-12);  // rounding
}

}  // namespace granulaw::node_slopes_test
