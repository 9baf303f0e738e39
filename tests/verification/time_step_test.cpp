// The time integration by itself. Pictures: docs/evidence/verification.md.
#include <gtest/gtest.h>

#include <cmath>

#include "convergence.hpp"

namespace granulaw::verification::time_step_test {

/// Central differences: the energy swings by an amount of second order in the step and does not drift.
TEST(TimeStep, EnergySwingIsOfSecondOrder)
{
  const double full = energy_swing(0.8), half = energy_swing(0.4), quarter = energy_swing(0.2);
  std::printf("energy swing %.2e, %.2e, %.2e at Courant 0.8, 0.4, 0.2\n", full, half, quarter);
  EXPECT_NEAR(std::log2(full / half), 2, 0.1);     // measured 2.00
  EXPECT_NEAR(std::log2(half / quarter), 2, 0.1);  // measured 2.01
}

}  // namespace granulaw::verification::time_step_test
