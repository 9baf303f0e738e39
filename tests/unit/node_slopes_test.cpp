#include "characterise/node_slopes.hpp"

#include <gtest/gtest.h>

#include "contact/cubic.hpp"

namespace granulaw {
namespace {

/// Smallest slope and value of the cubics through these nodes.
struct Least
{
  double slope = 1e9, value = 1e9;
  Least(const std::vector<double>& values, const std::vector<double>& slopes, double h)
  {
    for (std::size_t k = 0; k + 1 < values.size(); ++k) {
      double c[4];
      hermite(c, values[k], values[k + 1], h * slopes[k], h * slopes[k + 1]);
      for (int n = 0; n <= 100; ++n) {
        slope = std::min(slope, cubic_slope(c, 0.01 * n) / h);
        value = std::min(value, cubic(c, 0.01 * n));
      }
    }
  }
};

TEST(NodeSlopes, DifferencesAreExactForAParabola)
{
  const double h = 0.1;
  std::vector<double> values;
  for (int k = 0; k < 6; ++k) values.push_back(1 - 2 * k * h + 3 * k * h * k * h);
  const std::vector<double> slopes = difference_slopes(values, h);
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(slopes[static_cast<std::size_t>(k)], -2 + 6 * k * h, 1e-12);  // rounding
}

TEST(NodeSlopes, AKinkHasTheSlopeBeyondIt)
{
  const std::vector<double> slopes = difference_slopes_in_parts({0, 0, 0, 1, 3, 5}, 3, 1.0);
  EXPECT_EQ(slopes[2], 0);
  EXPECT_EQ(slopes[3], 2);
}

/// Steps, falls and plateaus: cubics between the nodes never fall.
TEST(NodeSlopes, ARisingFunctionRisesBetweenItsNodesToo)
{
  const Rising rising({0, 0, 1, 1.01, 0.5, 7, 7, 7.001, 20}, 0.3);
  EXPECT_EQ(rising.value[4], 1.01);
  EXPECT_EQ(rising.slope[0], 0);
  EXPECT_GE(Least(rising.value, rising.slope, 0.3).slope, -1e-12);  // rounding
}

TEST(NodeSlopes, APositiveFunctionIsPositiveBetweenItsNodesToo)
{
  const std::vector<double> values{1, 0.01, 0, 0.3, 2};
  std::vector<double> slopes;
  for (const double value : values) slopes.push_back(slope_of_a_positive(-5, value, 0.3));
  EXPECT_GE(Least(values, slopes, 0.3).value, -1e-12);  // rounding
}

}  // namespace
}  // namespace granulaw
