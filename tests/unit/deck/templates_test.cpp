#include "deck/commands/templates.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckTemplates = Deck;

TEST_F(DeckTemplates, UniformAndGaussianHaveARange)
{
  const auto source = [&](const std::string& radius) {
    std::string text = falling("");
    const std::string constant = "radius constant 0.002";
    return scene(text.replace(text.find(constant), constant.size(), "radius " + radius)).sources.at(0);
  };
  EXPECT_EQ(source("uniform 0.001 0.003").radius_min, 0.001);
  EXPECT_EQ(source("uniform 0.001 0.003").radius_max, 0.003);
  for (const char* kind : {"", "number ", "mass "}) {
    const Source s = source(std::string("gaussian ") + kind + "0.002 0.0002");
    EXPECT_NEAR(s.radius_min, 0.0014, 1e-15);  // three sigma
    EXPECT_NEAR(s.radius_max, 0.0026, 1e-15);
  }
  EXPECT_NEAR(source("gaussian 0.002 0.002").radius_min, 0.0002, 1e-15);  // not below a tenth of the mean
}

TEST_F(DeckTemplates, WhatIsNotUnderstoodIsNamed)
{
  const Scene s = scene(
      "units si\nfix p all particletemplate/sphere 1 radius lognormal 1 2\n"
      "fix q all particletemplate/sphere 1 radius constant -1\nfix r all particletemplate/multisphere 1");
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "radius 'lognormal'"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "must be positive"}));
  EXPECT_TRUE(holds(s.unknown_particles, {"in.deck:4", "particletemplate/multisphere", "only spheres"}));
}

}  // namespace
}  // namespace granulaw::deck
