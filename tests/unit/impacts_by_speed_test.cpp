#include "atlas/impacts_by_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_law.hpp"

namespace granulaw::impacts_by_speed_test {

using tests::SyntheticLaw;

constexpr double unit = 0.01;  // of kinetic energy

/// Effects `of` v at these speeds.
LawShape shape_of(const Curve& slow, const std::vector<double>& speeds, double (*of)(double))
{
  LawShape shape;
  for (const double v : speeds) {
    LawShape::VelocityEffect effect{v, 0, of(v), 2 * of(v), {}};
    effect.force.assign(LawShape::VelocityEffect::shares, 3 * of(v));
    double x = 1e-9;  // where the press's work is the kinetic energy
    while (slow.work(x) < unit * v * v) x *= 1.0001;
    effect.log_overlap = std::log(x / v) - of(v);
    shape.velocity_effects.push_back(effect);
  }
  return shape;
}

TEST(ImpactsBySpeed, InertiaGoesAsTheSquareOfTheSpeedFromTheStandstill)
{
  const Curve slow = SyntheticLaw{}.curve();
  const LawShape shape = shape_of(slow, {0.05, 0.1, 0.2, 0.3}, [](double v) { return v * v; });
  const ImpactsBySpeed impacts(shape, slow, unit, AxisTable::By::inertia);
  EXPECT_EQ(impacts.impact_overlap(0), 0);
  for (const double v : {0.01, 0.05, 0.13, 0.3}) {
    // exact: a parabola; 1e-9: rounding of the weights
    EXPECT_NEAR(impacts.effect(v).dissipation, v * v, 1e-9);
    EXPECT_NEAR(impacts.effect(v).residual, 2 * v * v, 1e-9);
    EXPECT_NEAR(impacts.effect(v).force.back(), 3 * v * v, 1e-9);
    const double x = impacts.impact_overlap(v) * std::exp(v * v);
    EXPECT_NEAR(slow.work(x) / (unit * v * v), 1, 5e-4);  // 1e-4 of x
    EXPECT_NEAR(impacts.speed(impacts.impact_overlap(v), 0, 0.3), v, 1e-9);
  }
}

TEST(ImpactsBySpeed, ARateGoesByTheLogarithmAndStaysBelowItsSlowest)
{
  const Curve slow = SyntheticLaw{}.curve();
  const LawShape shape =
      shape_of(slow, {0.01, 0.03, 0.1, 0.3}, [](double v) { return 0.01 * std::log(v / 0.001); });
  const ImpactsBySpeed impacts(shape, slow, unit, AxisTable::By::rate);
  EXPECT_NEAR(impacts.effect(0.05).dissipation, 0.01 * std::log(50.0), 1e-9);  // straight: rounding
  EXPECT_NEAR(impacts.effect(0.002).dissipation, 0.01 * std::log(10.0), 1e-9);
}

}  // namespace granulaw::impacts_by_speed_test
