#include "deck/speeds.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck::speeds_test {

TEST(DeckSpeeds, BoundsSpeedsByTheFall)
{
  const Plan plan = make_plan(falling(), {});
  ASSERT_EQ(plan.pairs.size(), 2u);
  const double v = std::sqrt(0.5 * 0.5 + 2 * 9.81 * (0.2 - 0.002));  // its lowest point comes down to the floor
  EXPECT_NEAR(plan.pairs[0].speed, 2 * v, 1e-12);  // without a law e is 1
  EXPECT_NEAR(plan.pairs[1].speed, v, 1e-12);
  EXPECT_EQ(plan.particle_steps, 0.5 * 100 * 1000);  // the mean of none before the run and 100 after it
  EXPECT_FALSE(plan.complete());                     // the yield stress is not in the deck
  EXPECT_TRUE(table_command(plan, "m.toml").empty());
}

TEST(DeckSpeeds, TheHighestSourceOfATypeCounts)
{
  Scene scene = falling();
  const double speed = make_plan(scene, {}).pairs[1].speed;
  Source& low = scene.sources.emplace_back(scene.sources[0]);
  low.centres.high[2] = 0.15, low.speed = 0.1;
  EXPECT_EQ(make_plan(scene, {}).pairs[1].speed, speed);
  std::swap(scene.sources[0], scene.sources[1]);
  EXPECT_EQ(make_plan(scene, {}).pairs[1].speed, speed);
}

}  // namespace granulaw::deck::speeds_test
