#include "deck/commands/settings.hpp"

#include <gtest/gtest.h>

#include <array>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckSettings = Deck;

TEST_F(DeckSettings, ReadsBoxGravityAndTimeStep)
{
  const Scene s = scene(
      "units si\nboundary p f m\nregion r block 0 1 0 2 0 3 units box\ncreate_box 3 r\n"
      "timestep 2e-6\nfix g all gravity 10 vector 0 3 4");
  EXPECT_EQ(s.periodic, (std::array{true, false, false}));
  EXPECT_EQ(s.types, 3);
  EXPECT_EQ(s.domain.high, (Vec3{1, 2, 3}));
  EXPECT_EQ(s.time_step, 2e-6);
  EXPECT_NEAR(s.gravity[1], 6, 1e-15);
  EXPECT_NEAR(s.gravity[2], 8, 1e-15);
}

TEST_F(DeckSettings, WhatCannotBeIsNamed)
{
  const Scene s = scene(
      "units si\ntimestep -1\nfix g all gravity 9.81 chute 30\nfix h all gravity 9.81 vector 0 0 0\n"
      "clear\natom_style superquadric");
  EXPECT_EQ(s.time_step, 0);
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "must be positive"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "gravity G vector x y z"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:4", "its vector is 0"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:5", "'clear'"}));
  EXPECT_TRUE(holds(s.unknown_particles, {"in.deck:6", "superquadric"}));
}

}  // namespace
}  // namespace granulaw::deck
