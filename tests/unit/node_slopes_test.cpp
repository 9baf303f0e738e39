#include "atlas/node_slopes.hpp"

#include <gtest/gtest.h>

#include "contact/cubic.hpp"

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

/// Steps, falls and plateaus: cubics between the nodes never fall.
TEST(NodeSlopes, AColumnMadeToRiseRisesBetweenItsNodesToo)
{
  const std::vector<double> x{0, 0.3, 0.6, 1, 1.1, 2, 2.5, 3, 3.1};
  HermiteColumn rising{{0, 0, 1, 1.01, 0.5, 7, 7, 7.001, 20}, {-1, 3, 4, 0, 9, 8, -2, 5, 100}};
  HermiteColumn falling = rising;
  make_rise(rising, x), make_fall(falling, x);
  EXPECT_EQ(rising.value[4], 1.01);
  EXPECT_EQ(falling.value[8], 0);
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const double h = x[k + 1] - x[k];
    double c[4];
    hermite(c, rising.value[k], rising.value[k + 1], h * rising.slope[k], h * rising.slope[k + 1]);
    EXPECT_GE(least_slope(c), -1e-12);  // rounding
    hermite(c, -falling.value[k], -falling.value[k + 1], -h * falling.slope[k], -h * falling.slope[k + 1]);
    EXPECT_GE(least_slope(c), -1e-12);
  }
}

}  // namespace granulaw::node_slopes_test
