#include "law/fast_axis.hpp"

#include <gtest/gtest.h>

#include <random>

#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::SyntheticLaw;

/// Of which kind the axis is, by its name in the test's name (a table itself would be printed there,
/// addresses and all).
class FastAxis : public ::testing::TestWithParam<std::string>
{
 protected:
  static VelocityAxis::Table table()
  {
    return GetParam() == "rate" ? SyntheticLaw{}.rate_axis(1e-3) : SyntheticLaw{}.axis();
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, FastAxis, ::testing::Values("inertia", "rate"),
                         [](const auto& kind) { return kind.param; });

TEST_P(FastAxis, IsTheAxisToRounding)
{
  const VelocityAxis axis(table(), "test");
  const granulaw::FastAxis fast(axis);
  const double end = axis.overlap_end();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(1e-3, 1.0);
  for (int k = 0; k < 20000; ++k) {
    // every tenth X at or beyond the last level, some before a rate's first; x also beyond ratio_end
    const double X = k % 10 == 0 ? end * (1.0 + (k % 20) * 0.01) : end * part(random);
    const double x = 1.2 * axis.table().ratio_end * X * part(random);
    const VelocityAxis::ForceCorrection a = axis.force(x, X), b = fast.force(x, X);
    // numbers of order one, each after some ten roundings; dA/dx is 1/X times such a number
    EXPECT_NEAR(a.value, b.value, 1e-13);
    EXPECT_NEAR(a.slope * X, b.slope * X, 1e-12);
    const VelocityAxis::ReversalCorrection c = axis.reversal(x, X), d = fast.reversal(x, X);
    EXPECT_NEAR(c.force, d.force, 1e-13);
    EXPECT_NEAR(c.residual, d.residual, 1e-13);
    EXPECT_NEAR(c.exponent, d.exponent, 1e-12);  // of order one
  }
}

}  // namespace
}  // namespace granulaw
