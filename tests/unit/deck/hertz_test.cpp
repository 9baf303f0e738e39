#include "deck/hertz.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace granulaw::deck::hertz_test {

TEST(Hertz, ConservesEnergy)
{
  const double e = 1e8, r = 0.002, m = 1e-4, v = 0.3, d = hertz_overlap(e, r, m, v);
  EXPECT_NEAR(8.0 / 15 * e * std::sqrt(r) * std::pow(d, 2.5) / (0.5 * m * v * v), 1, 1e-12);  // rounding
  // K. L. Johnson: 2.87 (m^2/(R E^2 V))^0.2, his factor in three digits
  EXPECT_NEAR(hertz_time(e, r, m, v) / (2.87 * std::pow(m * m / (r * e * e * v), 0.2)), 1, 2e-3);
}

}  // namespace granulaw::deck::hertz_test
