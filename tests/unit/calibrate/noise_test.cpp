#include "calibrate/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace granulaw::noise_test {

TEST(Noise, FindsTheShareOfACurveWithoutAModel)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Measurement m;
  m.kind = &kind_named("platens", "test");
  for (int k = 1; k <= 200; ++k) {
    const double x = k / 200.0;
    m.data.push_back({x, std::pow(x, 1.5) * (1 + 0.02 * normal(random)), 0, k});
  }
  // 196 pseudo-residuals, each of which shares four values with its neighbours: about 10 % of the sd
  EXPECT_NEAR(scatter_of(m).at(1.0), 0.02, 0.005);
}

TEST(Noise, FillsInWhatIsNotStated)
{
  Measurement m;
  m.data = {{1, 0.5, 0, 2}, {2, 0.4, 0.03, 3}};
  complete_standard_deviations(m, 0.01);
  EXPECT_DOUBLE_EQ(m.data[0].sd, 0.005);
  EXPECT_DOUBLE_EQ(m.data[1].sd, 0.03);
}

}  // namespace granulaw::noise_test
