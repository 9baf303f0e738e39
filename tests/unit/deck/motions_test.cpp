#include "deck/commands/motions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckMotions = Deck;

TEST_F(DeckMotions, MovingWallsAddTheirSpeed)
{
  write("a.stl", "vertex 0 0 0 vertex 0.1 0 0 vertex 0 0.1 0");
  const std::string mesh =
      "fix mesh all mesh/surface file a.stl type 2\n"
      "fix w2 all wall/gran model hertz mesh n_meshes 1 meshes mesh\nfix mv all move/mesh mesh mesh ";
  const auto speed = [&](const std::string& motion) { return scene(falling(mesh + motion)).walls[1].speed; };
  EXPECT_NEAR(speed("linear 3 4 0"), 5, 1e-12);
  EXPECT_NEAR(speed("wiggle amplitude 0 0 0.01 period 0.1"), 0.01 * 2 * M_PI / 0.1, 1e-12);
  EXPECT_NEAR(speed("rotate origin 0 0 0 axis 0 0 1 period 2"), M_PI * std::sqrt(0.02), 1e-12);
  // 1000 steps of 1e-5 s at 5 m/s: the mesh, and what lies on it, rises by 0.05 m
  EXPECT_NEAR(scene(falling(mesh + "linear 0 0 5")).walls[1].box.high[2], 0.05, 1e-12);
  const Scene unknown = scene(falling(mesh + "linear/variable v_x v_y v_z"));
  EXPECT_EQ(unknown.unknown_speeds.size(), 1u);
}

/// A quarter turn about z through the origin brings the corner (0.1, 0.1) to a distance of 0.1 sqrt(2).
TEST_F(DeckMotions, TurningMeshesSweepTheirCircle)
{
  write("a.stl", "vertex 0 0 0 vertex 0.1 0 0 vertex 0 0.1 0");
  const std::string mesh =
      "fix mesh all mesh/surface file a.stl type 2\nfix w2 all wall/gran mesh n_meshes 1 meshes mesh\n"
      "fix mv all move/mesh mesh mesh ";
  const Scene s = scene(falling(mesh + "rotate origin 0 0 0 axis 0 0 1 period 2"));
  EXPECT_NEAR(s.walls[1].box.low[0], -0.1 * std::sqrt(2), 1e-15);
  EXPECT_EQ(s.walls[1].box.high[2], 0);
  // it swings by 90 degrees each way: at its fastest pi/2 times 2 pi/T
  EXPECT_NEAR(scene(falling(mesh + "riggle origin 0 0 0 axis 0 0 1 period 2 amplitude 90")).walls[1].speed,
              M_PI / 2 * M_PI * std::sqrt(0.02), 1e-12);
  const Scene ended = scene(falling(mesh + "linear 0 0 5\nunfix mv"));
  EXPECT_EQ(ended.walls[1].box.high[2], 0);
}

TEST_F(DeckMotions, WhatHasNoKnownSpeedIsAskedFor)
{
  write("a.stl", "vertex 0 0 0 vertex 0.1 0 0 vertex 0 0.1 0");
  for (const char* motion :
       {"viblin axis 0 0 1 order 1", "wiggle amplitude 0 0 1", "linear/variable v_a v_b v_c"}) {
    const Scene s = scene(
        std::string("units si\nfix m all mesh/surface file a.stl\nfix v all move/mesh mesh m ") + motion);
    EXPECT_TRUE(holds(s.unknown_speeds, {"in.deck:3"})) << motion;
    EXPECT_TRUE(holds(s.notes, {"in.deck:3", "--speed"})) << motion;
  }
}

}  // namespace
}  // namespace granulaw::deck
