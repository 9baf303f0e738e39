#include "law/fast_pow.hpp"

#include <gtest/gtest.h>

#include <random>

namespace granulaw {
namespace {

TEST(FastPow, AgreesWithStdPow)
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> u_even(0.0, 1.0), log_u(-60.0, 0.0), n_all(0.01, 10.0);
  double worst = 0;
  for (int k = 0; k < 2000000; ++k) {
    const double u = k % 2 ? u_even(random) : std::exp(log_u(random)), n = n_all(random);
    const double expected = std::pow(u, n);
    if (u == 0.0 || expected < 1e-270) continue;
    worst = std::max(worst, std::abs(fast_pow(u, n) / expected - 1.0) / (1.0 + n));
  }
  // log2: r^5/5 with |r| < 1/128 leaves 6e-12 n; exp2: z^5/120 with |z| < 0.0109 leaves 2e-12
  EXPECT_LT(worst, 1e-11);
}

TEST(FastPow, Edges)
{
  EXPECT_NEAR(fast_pow(1.0, 1.5), 1.0, 2e-11);  // continuous with the loading branch to the error stated
  EXPECT_EQ(fast_pow(0.0, 1.5), 0.0);
  EXPECT_EQ(fast_pow(5e-324, 1.5), 0.0);
  EXPECT_EQ(fast_pow(1e-300, 9.0), 0.0);
  EXPECT_GT(fast_pow(1e-15, 1.5), 0.0);
}

TEST(FastPow, NeverFallsWhereUGrows)
{
  // sampled finely enough to meet every sub-interval of the tables, with steps well above the stated error
  for (double n : {1.0, 1.31, 1.5, 2.7})
    for (double u = 0.01; u < 1.0; u += 1e-5) EXPECT_LT(fast_pow(u, n), fast_pow(u + 1e-5, n)) << u;
}

}  // namespace
}  // namespace granulaw
