// Elastic contact against finite elements and against three formulations' common result.
#include <gtest/gtest.h>

#include <cmath>

#include "references.hpp"
#include "refusal.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/runs.hpp"

namespace granulaw::elastic_test {

TEST(ElasticImpact, ReturnsAllEnergy)
{
  const RunResult r = impact(reference::unit_sphere(0), {reference::elastic_impact_velocity()});
  EXPECT_GE(r.summary.restitution,
            0.999);  // what stays behind as vibration of the sphere is of order (V/c)^(3/5) 1e-3
  EXPECT_LE(r.summary.restitution, 1.0 + 1e-4);  // no energy from nowhere, beyond the step's own oscillation
  EXPECT_NEAR(r.summary.contact_time, reference::elastic_impact_time, 0.005 * reference::elastic_impact_time);
  EXPECT_NEAR(r.summary.force_max, reference::elastic_impact_force, 0.005 * reference::elastic_impact_force);
  EXPECT_LT(r.summary.energy_error, 1e-4);  // measured 1e-6: leapfrog's bounded oscillation
}

/// Depth by depth, as a user would who wants the force at one overlap: 0.5 % is required; the
/// reference itself is good to 0.1 %.
TEST(ElasticPress, AgreesWithFiniteElements)
{
  for (const double depth : {0.003, 0.01}) {
    PressPlan plan;
    plan.depth = depth;
    plan.support = Support::midplane;
    const RunResult r = press(reference::unit_sphere(0), plan);
    const TreatedLoading treated(r.trace);
    ASSERT_TRUE(treated.valid());
    for (const auto& point : reference::elastic_press)
      if (point.delta <= depth && point.delta >= 0.1 * depth) {
        EXPECT_NEAR(treated.force(point.delta) / point.force, 1.0, 0.005)
            << "delta/R = " << point.delta << " of a press to " << depth;
      }
    EXPECT_NEAR(r.summary.restitution, 1.0, 1e-3);  // measured 1.0002: vibration at the reversal
  }
}

TEST(GridNoise, MeanOverShiftedGridsRemovesIt)
{
  RunOptions one;
  one.resolution = 12;
  one.shifted_grids = 1;
  RunOptions four = one;
  four.shifted_grids = 4;
  const Particle sphere = reference::unit_sphere(100);
  PressPlan plan;
  plan.depth = 0.02;
  const double raw = press(sphere, plan, {}, one).summary.grid_noise;
  const double mean = press(sphere, plan, {}, four).summary.grid_noise;
  EXPECT_GT(raw, 0.005);       // there is a grid noise to remove
  EXPECT_LT(mean, 0.5 * raw);  // its first three harmonics are gone; the rest is at most 1/4 for a saw-tooth
}

TEST(BadInput, IsRefusedInOneSentence)
{
  const Particle good = reference::unit_sphere(100);
  Particle bad = good;
  bad.materials[0].youngs_modulus = -1;
  expect_error("youngs_modulus", [&] { impact(bad, {0.001}); });
  bad = good;
  bad.materials[0].poisson_ratio = 0.5;
  expect_error("poisson_ratio", [&] { impact(bad, {0.001}); });
  expect_error("velocity", [&] { impact(good, {-1}); });
  expect_error("wave speed", [&] { impact(good, {2.0}); });
  PressPlan plan;
  plan.depth = 1.5;
  expect_error("depth", [&] { press(good, plan); });
  RunOptions o;
  o.courant = 1.2;
  expect_error("courant", [&] { impact(good, {0.001}, {}, o); });
}

}  // namespace granulaw::elastic_test
