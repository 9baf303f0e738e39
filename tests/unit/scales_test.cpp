#include "base/scales.hpp"

#include <gtest/gtest.h>

namespace granulaw::scales_test {

TEST(Scales, YieldVelocityIsTheOneOfTheDesign)
{
  // rho V_y^2/Y = 25.5 (Y/E*)^4: (pi/2)^4 (2/5) 1.6^5
  const double e_star = 1e10, y = 1e8, rho = 1234;
  const double v = yield_velocity(e_star, y, rho);
  EXPECT_NEAR(rho * v * v / y / std::pow(y / e_star, 4), 25.5, 0.05);
}

/// (its pressures: Poisson/Onset.ClosedForm)
TEST(Scales, OnsetOverlapAndVelocityAreOfOneContact)
{
  // The impact that just reaches the onset overlap in Hertz's contact has the onset velocity.
  const double e_star = 1e10, y = 1e8, rho = 1500, nu = 0.3;
  const double x = onset_overlap(e_star, y, nu);
  const double energy = 8.0 / 15.0 * e_star * std::pow(x, 2.5);
  EXPECT_NEAR(std::sqrt(energy / (2.0 / 3.0 * M_PI * rho)) / onset_velocity(e_star, y, rho, nu), 1.0, 1e-12);
}

TEST(Scales, AreConsistent)
{
  const Scales scales{0.003, 2e10, 1700};
  EXPECT_DOUBLE_EQ(scales.time() * scales.velocity(), scales.length);
  EXPECT_NEAR(scales.mass() * scales.velocity() * scales.velocity(), scales.energy(),
              1e-12 * scales.energy());
  EXPECT_DOUBLE_EQ(scales.force() * scales.length, scales.energy());
}

}  // namespace granulaw::scales_test
