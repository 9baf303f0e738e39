#include "deck/commands/particles.hpp"

#include <gtest/gtest.h>

#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckParticles = Deck;

TEST_F(DeckParticles, SetChangesWhatCreateAtomsMade)
{
  const Scene t = scene("units cgs\ncreate_atoms 1 single 1 2 3\nset atom 1 diameter 0.4 density 2 vx 10");
  ASSERT_EQ(t.sources.size(), 1u);  // cgs: cm, g/cm^3, cm/s
  EXPECT_DOUBLE_EQ(t.sources[0].radius_max, 0.002);
  EXPECT_DOUBLE_EQ(t.sources[0].density, 2000);
  EXPECT_DOUBLE_EQ(t.sources[0].speed, 0.1);
}

TEST_F(DeckParticles, CreateAtomsFillsRegions)
{
  const std::string box = "units si\nregion r block 0 1 0 2 0 3 units box\ncreate_box 1 r\nlattice sc 0.5\n";
  for (const char* words : {"box", "region r"}) {
    const Scene s = scene(box + "create_atoms 1 " + words);
    EXPECT_EQ(s.count(), 48) << words;  // 6 m^3 of cells of 0.125 m^3
    EXPECT_EQ(s.sources[0].centres.high, (Vec3{1, 2, 3})) << words;
  }
  for (const char* region : {"NULL", "r"}) {
    const Scene s = scene(box + "create_atoms 1 random 10 1 " + region);
    EXPECT_EQ(s.count(), 10);
    EXPECT_EQ(s.sources[0].centres.high, (Vec3{1, 2, 3})) << region;
  }
  const Scene unknown = scene(box + "create_atoms 1 spiral 10");
  EXPECT_TRUE(holds(unknown.notes, {"in.deck:5", "'spiral' is not understood"}));
  EXPECT_TRUE(holds(unknown.unknown_particles, {"in.deck:5", "'spiral'"}));
}

TEST_F(DeckParticles, SetOfATypeLeavesTheOthers)
{
  const std::string two =
      "units si\ncreate_atoms 1 single 0 0 0\ncreate_atoms 2 single 1 0 0\n"
      "set group all diameter 0.002 density 500\n";
  const Scene s = scene(two + "set type 2 diameter 0.004 vz -3\nset atom 1 diameter 0.001\n");
  EXPECT_EQ(s.sources[0].radius_min, 0.0005);
  EXPECT_EQ(s.sources[0].radius_max, 0.001);
  EXPECT_EQ(s.sources[1].radius_max, 0.002);
  EXPECT_EQ(s.sources[0].speed, 0);
  EXPECT_EQ(s.sources[1].speed, 3);
  EXPECT_EQ(s.sources[1].density, 500);
  const Scene unknown = scene(two + "set atom 1 z 3\nset atom 1 shape 1 1 2\ndisplace_atoms all move 0 0 1");
  EXPECT_TRUE(holds(unknown.unknown_heights, {"in.deck:5", "set z"}));
  EXPECT_TRUE(holds(unknown.unknown_particles, {"in.deck:6", "shape"}));
  EXPECT_TRUE(holds(unknown.unknown_heights, {"in.deck:7", "displace_atoms"}));
}

TEST_F(DeckParticles, VelocitySetsTheSpeed)
{
  const std::string one = "units si\ncreate_atoms 1 single 0 0 0\nvelocity all ";
  EXPECT_EQ(scene(one + "set 3 NULL -4").sources[0].speed, 5);
  EXPECT_TRUE(holds(scene(one + "create 300 1").notes, {"in.deck:3", "velocity ... set"}));
}

}  // namespace
}  // namespace granulaw::deck
