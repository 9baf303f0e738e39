#include "deck/speeds.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck::speeds_test {

/// 200 spheres of radius 2 mm over a floor, 5 mm apart in height, aside by `aside(k)` m in x and y.
Scene tube(const std::function<std::array<double, 2>(int)>& aside)
{
  Scene s = falling();
  s.domain = {{0, 0, 0}, {0.03, 0.03, 1}};
  Source& cloud = s.sources[0];
  cloud.speed = 0, cloud.count = 200;
  for (int k = 1; k <= 200; ++k) {
    const auto [x, y] = aside(k);
    cloud.together.push_back({0.015 + x, 0.015 + y, 0.005 * k});
  }
  cloud.centres = {};
  for (const Vec3& p : cloud.together) cloud.centres.include(p);
  return s;
}

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

TEST(DeckSpeeds, ACloudShieldsItsFloor)
{
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> anywhere(-0.012, 0.012);
  const Scene cloud = tube([&](int) { return std::array{anywhere(dice), anywhere(dice)}; });
  const double fall = std::sqrt(2 * 9.81 * (1.0 - 0.002));
  const auto wall = [&](const Scene& s) { return make_plan(s, {}).pairs[1]; };
  EXPECT_EQ(wall(cloud).speed_basis, "shielded fall");
  EXPECT_LT(wall(cloud).speed, 0.9 * fall);
  EXPECT_NEAR(make_plan(cloud, {}).pairs[0].speed, 2 * fall, 1e-12);  // of pairs as ever
  // what it is not made for: one bound for all, as without it
  const std::vector<std::function<void(Scene&)>> others{
      [](Scene& s) { s.sources[0].together.clear(); },  // of several radii or densities, or in motion
      [](Scene& s) { s.sources.push_back(s.sources[0]); },
      [](Scene& s) { s.walls.push_back(floor_at(-0.1)); },
      [](Scene& s) {
        s.walls.push_back({"", "c", 2, {{-0.1, -0.1, 0}, {0.1, 0.1, 1}}, 0, 0, false, ""});
      },
      [](Scene& s) { s.walls[0].speed = 0.1; },
      [](Scene& s) { s.unknown_speeds.push_back("in.deck:9: fix addforce"); }};
  for (std::size_t k = 0; k < others.size(); ++k) {
    Scene other = cloud;
    others[k](other);
    EXPECT_EQ(wall(other).speed_basis, "fall") << k;
  }
  // in line they hand the whole fall on
  EXPECT_EQ(wall(tube([](int) { return std::array{0.0, 0.0}; })).speed_basis, "fall");
  // a wall along gravity may be hit by anything; the floor under it stays shielded
  Scene side = cloud;
  side.walls.push_back({"", "side", 3, {{0, 0, 0}, {0, 0.03, 1}}, 0, 0, false, ""});
  const Plan sides = make_plan(side, {});
  EXPECT_EQ(sides.pairs[1].speed_basis, "shielded fall");
  EXPECT_EQ(sides.pairs[2].speed_basis, "fall");
}

}  // namespace granulaw::deck::speeds_test
