#include "calibrate/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

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

/// Rows between which a curve was interpolated say no more than those that were measured.
TEST(Noise, InterpolatedRowsHaveTheNoiseOfThoseMeasured)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Measurement measured;
  measured.kind = &kind_named("platens", "test");
  for (int k = 1; k <= 50; ++k) {
    const double x = k / 50.0;
    measured.data.push_back({x, std::pow(x, 1.5) * (1 + 0.02 * normal(random)), 0, k});
  }
  const auto information = [](const Measurement& m) {
    double sum = 0;
    for (const Datum& d : m.data) sum += d.y * d.y / (d.sd * d.sd);
    return sum;
  };
  std::vector<double> found;
  for (const int between : {1, 20, 200}) {
    Measurement m = measured;
    m.data.clear();
    for (std::size_t k = 0; k + 1 < measured.data.size(); ++k)
      for (int i = 0; i < between; ++i) {
        const Datum &a = measured.data[k], &b = measured.data[k + 1];
        const double u = static_cast<double>(i) / between;
        m.data.push_back({a.x + u * (b.x - a.x), a.y + u * (b.y - a.y), 0, 1});
      }
    complete_standard_deviations(m, 0.01);
    found.push_back(information(m));
  }
  // a straight line between two rows averages them, so means over two rows have 3/8 of a row's square, not a half;
  // and the scatter of fifty rows is known to a fifth
  EXPECT_LT(found[1], 3 * found[0]);
  EXPECT_LT(found[2], 3 * found[0]);
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
