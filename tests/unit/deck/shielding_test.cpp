#include "deck/shielding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace granulaw::deck::shielding_test {

/// Spheres of radius 1 in a column on the floor z = 0, g = 1; `aside`: of the second one.
Cloud column(std::size_t count, double aside = 0.1)
{
  Cloud c;
  c.radius = 1, c.g = 1;
  for (std::size_t k = 0; k < count; ++k)
    c.centres.push_back({k == 1 ? aside : 0, 0, 2.0 + 2.1 * static_cast<double>(k)});
  return c;
}

TEST(Shielding, ASphereWithNoneBelowLandsUnhindered)
{
  // centres at 2 and 4.1, two diameters aside; bisection to 1e-6
  EXPECT_NEAR(landing_speed(column(2, 4)), std::sqrt(2 * 3.1), 1e-5);
  // through a periodic side it has one below again
  Cloud wrapped = column(2, 6.5);
  wrapped.domain = {{0, 0, 0}, {7, 7, 9}};
  EXPECT_NEAR(landing_speed(wrapped, 1.0), std::sqrt(2 * 3.1), 1e-5);
  wrapped.periodic = {true, true, false};
  // one collision: 2 (1 - u/v) carriers above u, 0.5 of them at 3/4 v
  EXPECT_NEAR(landing_speed(wrapped, 0.5), 0.75 * std::sqrt(2 * 3.1), 1e-5);
}

TEST(Shielding, CarriersOfSpeedAreAsManyAsDiceGive)
{
  constexpr std::size_t m = 4;
  Cloud c = column(m + 1);
  const double u = landing_speed(c, 0.3), lowest = std::sqrt(2.0);
  ASSERT_GT(u, lowest);  // so the lowest sphere takes no part
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> share(0, 1);
  double sum = 0, squares = 0;
  constexpr int runs = 100000;
  for (int r = 0; r < runs; ++r) {
    double count = 0;
    for (std::size_t k = 1; k <= m; ++k) {
      std::vector<double> speeds{std::sqrt(2 * (1 + 2.1 * static_cast<double>(k)))};
      for (std::size_t hit = 0; hit < k; ++hit) {
        std::vector<double> next;
        for (const double v : speeds) {
          const double x = share(dice);
          next.push_back(x * v), next.push_back((1 - x) * v);
        }
        speeds = next;
      }
      for (const double v : speeds) count += v > u;
    }
    sum += count, squares += count * count;
  }
  const double mean = sum / runs, error = std::sqrt((squares / runs - mean * mean) / runs);
  EXPECT_NEAR(mean, 0.3, 4 * error);  // one of 16,000 correct programs fails; the dice are the same each time
  EXPECT_LT(error, 0.003);
}

}  // namespace granulaw::deck::shielding_test
