#include "base/larger.hpp"
#include "deck/plan.hpp"
#include "law/range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deck_fixture.hpp"

namespace granulaw::deck::plan_test {

Plan plan_of(const Scene& scene, double speed)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  options.speed = speed;
  return make_plan(scene, options);
}

TEST(DeckPlan, TheTableReachesAFifthBeyondInTwoDigits)
{
  const Scene s = falling();
  for (const double speed : {0.05, 0.3, 2.0}) {
    const Plan plan = plan_of(s, speed);
    double depth = 0, damage_number = 0;
    for (const PairPlan& p : plan.pairs)
      depth = larger(depth, p.depth), damage_number = larger(damage_number, p.damage_number);
    ASSERT_GT(depth, 0);
    const double largest_depth = std::clamp(1.2 * depth, shallowest_table, 0.5),
                 largest_inertia = std::min(0.09, 1.2 * damage_number);
    EXPECT_GE(plan.depth, largest_depth);
    EXPECT_LE(plan.depth, std::min(0.5, 1.1 * largest_depth));
    EXPECT_GE(plan.damage_number, largest_inertia);
    EXPECT_LE(plan.damage_number, std::min(0.09, 1.1 * largest_inertia));
    EXPECT_EQ(plan.axis_matters, damage_number > negligible_damage_number);
  }
}

TEST(DeckPlan, TheCostIsThatOfAllRuns)
{
  Scene s = falling();
  s.runs.push_back({"in.deck:12", 1000, 1e-5, 100});
  EXPECT_EQ(plan_of(s, 1).particle_steps, 50 * 1000 + 100 * 1000);
  PlanOptions options;
  options.particles = 7;
  options.rate = 1000;
  EXPECT_EQ(make_plan(s, options).particle_steps, 14000);
  EXPECT_DOUBLE_EQ(make_plan(s, options).hours, 14.0 / 3600);
}

TEST(DeckPlan, ASingleParticleMeetsOnlyWalls)
{
  Scene s = falling();
  s.sources[0].count = 1;
  const Plan one = plan_of(s, 1);
  s.sources[0].count = 2;
  const Plan two = plan_of(s, 1);
  ASSERT_EQ(one.pairs.size(), 1u);
  EXPECT_TRUE(one.pairs[0].meeting.wall);
  EXPECT_EQ(two.pairs.size(), 2u);
}

/// Walls of one type count once, rigid and deformable ones apart, at the fastest approach.
TEST(DeckPlan, WallsOfATypeAreOneBody)
{
  Scene s = falling();
  s.walls.push_back(floor_at(-0.1));
  s.walls.push_back(floor_at(0));
  s.walls.back().deformable = true;
  const Plan plan = make_plan(s, {});
  ASSERT_EQ(plan.pairs.size(), 3u);
  EXPECT_FALSE(plan.pairs[1].meeting.deformable);
  EXPECT_TRUE(plan.pairs[2].meeting.deformable);
  EXPECT_NEAR(plan.pairs[1].speed, std::sqrt(0.5 * 0.5 + 2 * 9.81 * (0.3 - 0.002)), 1e-12);
}

/// The stress of 30 resolved spheres (docs/evidence/packings.md), linear between; the last piece goes on.
TEST(DeckPlan, APressHasThePressureOfAResolvedBed)
{
  EXPECT_EQ(pressing_to(0.5).pressure, 0);
  EXPECT_NEAR(pressing_to(0.705).pressure, 0.235, 1e-12);
  EXPECT_NEAR(pressing_to(1.0).pressure, 1.644, 1e-12);
  EXPECT_NEAR(pressing_to(0.78).overlap, 1 - std::cbrt(0.58 / 0.78), 1e-12);
  EXPECT_FALSE(pressing_to(0.6).needs_confinement());
  EXPECT_TRUE(pressing_to(0.61).needs_confinement());
  EXPECT_NEAR(plan_of(falling(), 1).pressing.time_step, 0.05 * plan_of(falling(), 1).radius_min * std::sqrt(1000 / (91e6 / 0.91)), 1e-12);
}

}  // namespace granulaw::deck::plan_test
