// Attraction between the surfaces of a sphere and the plane, against earlier runs and closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "references.hpp"
#include "solver/runs.hpp"

namespace granulaw::adhesion_test {

RunOptions one_grid(int cells)
{
  RunOptions options;
  options.shifted_grids = 1;
  options.resolution = cells;
  return options;
}

/// E*/Y = 100 pressed to 0.02 R between platens; chi = 0.1, S = 0.6: 0.1487 of the force at the dent, by runs whose attraction began
/// after the loading (48 cells). R = E* = 1.
TEST(CohesivePress, DrawsOffADent)
{
  PressPlan plan;
  plan.depth = 0.02, plan.support = Support::midplane;
  constexpr double work = 1.01e-5, pressure = 0.0235, strength = 0.6 * pressure;
  Partner plane;
  plane.attraction = {work, 2 * work / strength};
  const RunSummary s = press(reference::unit_sphere(100, 0.3, 0), plan, plane, one_grid(30)).summary;
  // 5 %: one grid of fewer cells, and attraction while it is pressed
  EXPECT_NEAR(s.pull_off / s.force_max, 0.1487, 0.05 * 0.1487);
  EXPECT_GT(s.adhesion_loss, 0.0);
  EXPECT_LT(s.energy_error, 1e-3);  // kinetic, elastic and plastic energy, contact and attraction
}

TEST(CohesivePress, RefusesAnEdgeThatTheGridCannotPart)
{
  PressPlan plan;
  plan.depth = 0.02, plan.support = Support::midplane;
  Partner plane;
  plane.attraction = {1e-6, 1e-5};
  EXPECT_THROW(press(reference::unit_sphere(100, 0.3, 0), plan, plane, one_grid(20)), Error);
}

/// Slow elastic spheres stick, faster ones leave with the energy that is left. A long range: the sticking speed lies between Johnson,
/// Kendall and Roberts's and twice it (docs/evidence/adhesion.md).
TEST(CohesiveImpact, SticksOrLeaves)
{
  constexpr double work = 1e-4;
  Partner plane;
  plane.attraction = {work, 2.2e-3};  // Tabor 1.0
  const double mass = 4.0 / 3.0 * M_PI, sticking = std::sqrt(2 * 7.09 * std::cbrt(std::pow(work, 5)) / mass);
  const RunSummary slow = impact(reference::unit_sphere(0, 0.3, 0), {.velocity = 0.7 * sticking}, plane, one_grid(40)).summary;
  EXPECT_TRUE(slow.sticks);
  EXPECT_EQ(slow.restitution, 0);
  const RunSummary fast = impact(reference::unit_sphere(0, 0.3, 0), {.velocity = 3 * sticking}, plane, one_grid(50)).summary;
  EXPECT_FALSE(fast.sticks);
  EXPECT_GT(fast.pull_off, 0);
  EXPECT_LT(fast.restitution, std::sqrt(1 - 1 / 9.0) + 0.01);
  EXPECT_GT(fast.restitution, 0.5);
}

}  // namespace granulaw::adhesion_test
