#include "deck/commands/materials.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckMaterials = Deck;

TEST_F(DeckMaterials, ReadsPropertiesByType)
{
  const Scene s = scene(
      "units si\nfix a all property/global youngsModulus peratomtype 1e6 2e6\n"
      "fix b all property/global poissonsRatio peratomtype 0.2 0.3\n"
      "fix c all property/global yieldStress peratomtype 1e4\n"
      "fix d all property/global coefficientRestitution peratomtypepair 2 0.9 0.5 0.5 0.7\n"
      "fix e all property/global coefficientFriction peratomtypepair 2 0.9 0.5 0.5 0.7\n");
  EXPECT_EQ(s.materials.at(1).youngs_modulus, 1e6);
  EXPECT_EQ(s.materials.at(2).youngs_modulus, 2e6);
  EXPECT_EQ(s.materials.at(2).poisson_ratio, 0.3);
  EXPECT_EQ(s.materials.at(1).yield_stress, 1e4);
  EXPECT_FALSE(s.materials.at(2).yield_stress);
  EXPECT_EQ(s.restitution, 0.5);
  EXPECT_TRUE(s.notes.empty());
}

TEST_F(DeckMaterials, WhatCannotBeIsNamed)
{
  const Scene s = scene(
      "units si\nfix a all property/global youngsModulus scalar 1e6\n"
      "fix b all property/global poissonsRatio peratomtype 0.7\n"
      "fix c all property/global yieldStress peratomtype 0\n");
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "youngsModulus must be peratomtype"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "0.7 is no Poisson's ratio"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:4", "yieldStress must be positive"}));
}

}  // namespace
}  // namespace granulaw::deck
