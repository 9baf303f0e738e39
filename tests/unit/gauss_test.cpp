#include "base/gauss.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace granulaw::gauss_test {

/// x^k from -0.5 to 2 is exact to rounding up to k = 2 n - 1 and no further.
template <int n>
void expect_degree()
{
  for (int k = 0; k <= 2 * n; ++k) {
    const double exact = (std::pow(2.0, k + 1) - std::pow(-0.5, k + 1)) / (k + 1);
    const double found = gauss<n>(-0.5, 2.0, [&](double x) { return std::pow(x, k); });
    if (k < 2 * n)
      EXPECT_NEAR(found / exact, 1, 1e-14) << n << " points, degree " << k;
    else
      EXPECT_GT(std::abs(found / exact - 1), 1e-10) << n << " points, degree " << k;
  }
}

TEST(Gauss, ExactToItsDegree)
{
  expect_degree<2>();
  expect_degree<4>();
  expect_degree<7>();
}

}  // namespace granulaw::gauss_test
