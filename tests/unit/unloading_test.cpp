#include "contact/unloading.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace granulaw::unloading_test {

/// Any shape that rises.
UnloadingShape any_shape()
{
  const double hertz_share = UnloadingShape::largest_hertz_share * *rc::gen::inRange(0, 1001) / 1000.0;
  return {UnloadingShape::largest_exponent(hertz_share) * *rc::gen::inRange(0, 1001) / 1000.0, hertz_share};
}

TEST(Unloading, HoldsPowersExactly)
{
  for (const double u : {0.0, 1e-12, 0.01, 0.3, 0.77, 1.0}) {
    // 1e-15: rounding of some operations on numbers of order one
    EXPECT_NEAR((UnloadingShape{1.5, 1}.at(u).value), std::pow(u, 1.5), 1e-15);
    EXPECT_NEAR((UnloadingShape{2.0, 0}.at(u).value), u * u, 1e-15);
    EXPECT_NEAR((UnloadingShape{2.5, 0}.at(u).value), std::pow(u, 2.5), 1e-15);
  }
  EXPECT_NEAR((UnloadingShape{1.5, 1}.work()), 0.4, 1e-15);
  EXPECT_NEAR((UnloadingShape{2.0, 0}.work()), 1 / 3.0, 1e-15);
}

/// F = x^1.5 (1 + c1 sqrt(x) + c2 x) from any reversal.
TEST(Unloading, HoldsTheElasticSpheresCurve)
{
  const double c1 = 0.87, c2 = 0.4, top = 0.04;
  const auto force = [&](double x) { return std::pow(x, 1.5) * (1 + c1 * std::sqrt(x) + c2 * x); };
  const double a = std::pow(top, 1.5) / force(top), b = a * c1 * std::sqrt(top), c = 1 - a - b;
  const UnloadingShape shape{1.5 * a + 2 * b + 2.5 * c, a};
  for (const double u : {0.01, 0.2, 0.6, 0.99})
    EXPECT_NEAR(shape.at(u).value, force(u * top) / force(top), 1e-15);
}

RC_GTEST_PROP(Unloading, RisesFromNothingToTheForceOfTheReversal, ())
{
  const UnloadingShape shape = any_shape();
  RC_ASSERT(shape.rises());
  RC_ASSERT(shape.at(0).value == 0 && std::abs(shape.at(1).value - 1) < 1e-14);
  RC_ASSERT(std::abs(shape.at(1).slope - shape.exponent) < 1e-14);
  double before = 0;
  for (int k = 1; k <= 500; ++k) {
    const auto [value, slope] = shape.at(k / 500.0);
    RC_ASSERT(value >= before - 1e-15 && slope >= -1e-14);  // rounding of terms up to 20
    before = value;
  }
}

/// A shape outside those bounds does fall somewhere: they are not wider than need be where it matters.
TEST(Unloading, AHertzShareBelowZeroIsANegativeForce)
{
  EXPECT_FALSE((UnloadingShape{1.5, -0.1}.rises()));
  EXPECT_LT((UnloadingShape{1.5, -0.1}.at(1e-4).value), 0);
}

RC_GTEST_PROP(Unloading, SlopeAndWorkAreItsDerivativeAndIntegral, ())
{
  using boost::math::quadrature::gauss_kronrod;
  const UnloadingShape shape = any_shape();
  const double u = *rc::gen::inRange(1, 1000) / 1000.0, step = 1e-6 * u;
  const double slope = (shape.at(u + step).value - shape.at(u - step).value) / (2 * step);
  RC_ASSERT(std::abs(shape.at(u).slope - slope) < 1e-8);  // cancellation: 1e-15 over 1e-6 u, times value/u
  // u = w^2: smooth at 0
  const auto in_w = [&](double w) { return 2 * w * shape.at(w * w).value; };
  const double integral = gauss_kronrod<double, 31>::integrate(in_w, 0.0, std::sqrt(u), 5, 1e-13);
  RC_ASSERT(std::abs(shape.work(u) - integral) < 1e-13);
  RC_ASSERT(std::abs(shape.work(1) - shape.work()) < 1e-14);
  RC_ASSERT(std::abs(UnloadingShape::exponent_of(shape.work(), shape.hertz_share) - shape.exponent) < 1e-13);
}

/// Under a uniform pressure a stack of flat punches leaves: a = a_m sin t at u = 1 - cos t, so k = sqrt(2 - u).
TEST(Unloading, RadiusIsThatOfKnownPressures)
{
  const UnloadingRadius uniform{{std::sqrt(2.0), std::sqrt(2 - 1 / 9.0), std::sqrt(2 - 4 / 9.0)}};
  for (const double root : {0.0, 0.1, 0.25, 0.5, 0.7, 0.9, 1.0}) {
    EXPECT_NEAR(uniform.share(root), root * std::sqrt(2 - root * root), 2e-3) << root;  // a cubic by the root
    EXPECT_NEAR(UnloadingRadius{}.share(root), root, 1e-15);
  }
  EXPECT_EQ((UnloadingRadius{{1, 1, 2}}.share(0.8)), 1);  // never wider than at full load
}

}  // namespace granulaw::unloading_test
