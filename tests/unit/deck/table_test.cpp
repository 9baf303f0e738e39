#include "deck/commands/table.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckTable = Deck;

TEST_F(DeckTable, AnUnknownCommandIsNamedWithTheNearest)
{
  const Scene s = scene("units si\ntimstep 1e-5\nthermo_stile custom step\nxyzzy 1");
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "'timstep'", "did you mean 'timestep'?"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "did you mean 'thermo_style'?"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:4", "'xyzzy' is not followed: it is not known to mpm plan"}));
  EXPECT_EQ(s.notes.size(), 3u);
}

TEST_F(DeckTable, WhatHasNoBearingIsPassedOver)
{
  const Scene s = scene(
      "units si\nprint ${unknown}\nthermo 100\ndump d all custom 1 f id\nfix i all nve/sphere\n"
      "fix c all check/timestep/gran 1 0.1 0.1\ncompute k all ke");
  EXPECT_TRUE(s.notes.empty()) << s.notes[0];
}

/// What is cut off, or holds a variable without a value, is named with file and line.
TEST_F(DeckTable, WhatCannotBeFollowedIsNamed)
{
  for (const char* command : {"atom_style",
                              "boundary",
                              "create_atoms",
                              "create_box",
                              "fix",
                              "lattice",
                              "read_data ${v}",
                              "region",
                              "run",
                              "set",
                              "timestep",
                              "unfix",
                              "velocity",
                              "clear",
                              "fix i all gravity",
                              "fix i all insert/pack distributiontemplate",
                              "fix i all move/mesh",
                              "fix i all particledistribution/discrete",
                              "fix i all particletemplate/sphere 1 radius",
                              "fix i all property/global",
                              "fix i all wall/gran",
                              "fix i all mesh/surface"}) {
    const Scene s = scene(std::string("units si\n") + command);
    ASSERT_EQ(s.notes.size(), 1u) << command;
    EXPECT_TRUE(holds(s.notes, {"in.deck:2", "is not followed"})) << s.notes[0];
  }
  EXPECT_TRUE(holds(scene("units si\nfix i all gravity ${v}").notes, {"'fix gravity'", "'v'"}));
}

TEST_F(DeckTable, FixesThatHideParticlesOrSpeedsAreNamed)
{
  for (const char* style : {"adapt", "multisphere", "rigid", "rigid/nve"})
    EXPECT_TRUE(
        holds(scene(std::string("units si\nfix i all ") + style).unknown_particles, {"in.deck:2", style}));
  for (const char* style :
       {"addforce", "setforce", "drag", "move", "couple/cfd", "nve/limit", "nve/limit/sphere"})
    EXPECT_TRUE(
        holds(scene(std::string("units si\nfix i all ") + style).unknown_speeds, {"in.deck:2", style}));
}

TEST_F(DeckTable, AnUnknownFixIsNamedWithTheNearest)
{
  const Scene s = scene("units si\nfix i all nve/spheer\nfix j all deform 1 x erate 1\nfix k all nve/sphere\n");
  EXPECT_EQ(s.notes.size(), 2u);
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "'fix nve/spheer'", "not known", "nve/sphere"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "'fix deform'", "not known"}));
}

TEST_F(DeckTable, UnfixEndsAnInsertion)
{
  const std::string all = falling("run 1000", "nparticles 5000 particlerate 1000 region bc");
  EXPECT_EQ(scene(all).count(), 20);  // 1000/s over twice 0.01 s
  std::string ended = all;
  ended.insert(ended.rfind("run"), "unfix ins\n");
  EXPECT_EQ(scene(ended).count(), 10);
}

}  // namespace
}  // namespace granulaw::deck
