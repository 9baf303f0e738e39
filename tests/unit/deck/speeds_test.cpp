#include "deck/speeds.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckSpeeds = Deck;

/// A data file of 200 spheres of radius 2 mm, 5 mm apart in height, aside by `aside(k)` m in x and
/// y.
std::string tube(const std::function<std::array<double, 2>(int)>& aside)
{
  std::string text =
      "cloud\n\n200 atoms\n1 atom types\n0 0.03 xlo xhi\n0 0.03 ylo yhi\n0 1 zlo zhi\n\nAtoms\n\n";
  for (int k = 1; k <= 200; ++k) {
    const auto [x, y] = aside(k);
    text += std::to_string(k) + " 1 0.004 1000 " + std::to_string(0.015 + x) + " " +
            std::to_string(0.015 + y) + " " + std::to_string(0.005 * k) + "\n";
  }
  return text;
}

TEST_F(DeckSpeeds, BoundsSpeedsByTheFall)
{
  const Plan plan = make_plan(scene(falling("")), {});
  ASSERT_EQ(plan.pairs.size(), 2u);
  const double v = std::sqrt(0.5 * 0.5 + 2 * 9.81 * 0.2);
  EXPECT_NEAR(plan.pairs[0].speed, 2 * v, 1e-12);
  EXPECT_NEAR(plan.pairs[1].speed, v, 1e-12);
  EXPECT_EQ(plan.particle_steps, 0.5 * 100 * 1000);  // the mean of none before the run and 100 after it
  EXPECT_FALSE(plan.complete());                     // the yield stress is not in the deck
  EXPECT_TRUE(table_command(plan, "m.toml").empty());
}

TEST_F(DeckSpeeds, ACloudShieldsItsFloor)
{
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> anywhere(-0.012, 0.012);
  write("cloud", tube([&](int) { return std::array{anywhere(dice), anywhere(dice)}; }));
  const std::string more =
      "units si\nread_data cloud\nfix m1 all property/global youngsModulus peratomtype 91e6 210e9\n"
      "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\nfix g all gravity 9.81 vector 0 0 -1\n"
      "fix w all wall/gran model hertz primitive type 2 zplane 0.0\n";
  const double fall = std::sqrt(2 * 9.81 * 1.0);
  const auto wall = [&](const std::string& text) { return make_plan(scene(text), {}).pairs[1]; };
  EXPECT_EQ(wall(more).speed_basis, "shielded fall");
  EXPECT_LT(wall(more).speed, 0.9 * fall);
  EXPECT_NEAR(make_plan(scene(more), {}).pairs[0].speed, 2 * fall, 1e-12);  // of pairs as ever
  // what it is not made for: one bound for all, as without it
  for (const char* other :
       {"velocity all set 0 0 -0.1\n", "set atom 3 diameter 0.006\n", "set atom 3 density 2000\n",
        "create_atoms 1 single 0 0 0.1\n", "fix w2 all wall/gran model hertz primitive type 2 zplane -0.1\n",
        "fix w2 all wall/gran model hertz primitive type 2 zcylinder 0.1 0 0\n"})
    EXPECT_EQ(wall(more + other).speed_basis, "fall") << other;
  // in line they hand the whole fall on
  write("cloud", tube([](int) { return std::array{0.0, 0.0}; }));
  EXPECT_EQ(wall(more).speed_basis, "fall");
  write("cloud", tube([&](int) { return std::array{anywhere(dice), anywhere(dice)}; }));
  // a wall along gravity may be hit by anything; the floor under it stays shielded
  const Plan sides =
      make_plan(scene(more + "fix w2 all wall/gran model hertz primitive type 3 xplane 0.0\n"), {});
  EXPECT_EQ(sides.pairs[1].speed_basis, "shielded fall");
  EXPECT_EQ(sides.pairs[2].speed_basis, "fall");
}

}  // namespace
}  // namespace granulaw::deck
