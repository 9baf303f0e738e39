#include "deck/commands/data_file.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckDataFile = Deck;

TEST_F(DeckDataFile, ReadsAtomsBoxAndVelocities)
{
  write("cloud",
        "Atoms of a cloud\n\n2 atoms\n2 atom types\n-1 2 xlo xhi\n-3 4 ylo yhi\n-5 6 zlo zhi\n\nAtoms\n\n"
        "1 1 0.002 900 0.5 0.5 0.1\n2 1 0.004 800 0.6 0.4 0.7\n");
  const Scene s = scene("units si\nread_data cloud");
  ASSERT_EQ(s.sources.size(), 1u);
  EXPECT_EQ(s.sources[0].radius_min, 0.001);
  EXPECT_EQ(s.sources[0].radius_max, 0.002);
  EXPECT_EQ(s.sources[0].centres.low, (Vec3{0.5, 0.4, 0.1}));
  EXPECT_EQ(s.sources[0].centres.high, (Vec3{0.6, 0.5, 0.7}));
  EXPECT_EQ(s.sources[0].density, 900);
  EXPECT_EQ(s.domain.low, (Vec3{-1, -3, -5}));
  EXPECT_EQ(s.domain.high, (Vec3{2, 4, 6}));
  EXPECT_EQ(s.types, 2);
  EXPECT_EQ(s.count(), 2);
  EXPECT_EQ(s.sources[0].speed, 0);
  write("moving",
        "title\n\n2 atoms\n\nAtoms\n\n1 1 0.002 900 0 0 0\n2 2 0.002 900 1 0 0\n\nVelocities\n\n"
        "1 0 0 0.5 0 0 0\n2 3 0 -4 0 9 0\n");
  const Scene m = scene("units si\nread_data moving");
  ASSERT_EQ(m.sources.size(), 2u);
  EXPECT_EQ(m.sources[0].speed, 0.5);
  EXPECT_EQ(m.sources[1].speed, 5);
  write("stranger", "title\n\n1 atoms\n\nAtoms\n\n1 1 0.002 900 0 0 0\n\nVelocities\n\n7 0 0 1 0 0 0\n");
  EXPECT_THROW(scene("units si\nread_data stranger"), Error);
  write("bad", "title\n\n1 atoms\n\nAtoms\n\n1 1 0.002\n");
  EXPECT_THROW(scene("read_data bad"), Error);
  EXPECT_THROW(scene("read_data missing"), Error);
}

/// Comments, blank lines and sections that are not read.
TEST_F(DeckDataFile, PassesOverWhatItDoesNotNeed)
{
  write("cloud",
        "Velocities and Atoms of a title\n\n1 atoms # one\n\nBodies\n\n9 9 9 9\n\nAtoms # granular\n\n"
        "1 3 0.002 900 0 0 0\n");
  const Scene s = scene("units si\nread_data cloud");
  ASSERT_EQ(s.sources.size(), 1u);
  EXPECT_EQ(s.sources[0].type, 3);
  EXPECT_TRUE(s.notes.empty());
  write("empty", "title\n\n5 atoms\n");
  EXPECT_TRUE(holds(scene("units si\nread_data empty").notes, {"holds no section Atoms"}));
}

TEST_F(DeckDataFile, RestartFilesAreAskedFor)
{
  const Scene s = scene("units si\nread_restart x");
  EXPECT_TRUE(holds(s.unknown_particles, {"in.deck:2: read_restart"}));
  EXPECT_TRUE(holds(s.unknown_heights, {"in.deck:2: read_restart"}));
}

}  // namespace
}  // namespace granulaw::deck
