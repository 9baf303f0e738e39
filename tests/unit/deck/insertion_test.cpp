#include "deck/commands/insertion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckInsertion = Deck;

TEST_F(DeckInsertion, CountsInsertedParticles)
{
  const double ball = 4.0 / 3.0 * M_PI * 8e-9, region = M_PI * 0.05 * 0.05 * 0.1;
  EXPECT_NEAR(scene(falling("", "volumefraction_region 0.3 region bc")).count(), 0.3 * region / ball, 1e-6);
  EXPECT_EQ(scene(falling("", "nparticles 5000 particlerate 1000 region bc")).count(),
            10);  // 1000/s over 0.01 s
  EXPECT_NEAR(scene(falling("", "mass 0.1 massrate 100 region bc")).count(), 0.1 / (1000 * ball), 1e-6);
}

/// Weights are shares of mass: of equal masses of balls with 8 times the volume there are 8 times fewer.
TEST_F(DeckInsertion, SharesOfMassBecomeSharesOfNumber)
{
  std::string text = falling("", "nparticles 900 region bc");
  const std::string one = "1 1 p 1.0";
  text.replace(text.find(one), one.size(), "1 2 p 0.5 big 0.5");
  text.insert(
      text.find("fix d"),
      "fix big all particletemplate/sphere 1 atom_type 2 density constant 1000 radius constant 0.004\n");
  const Scene s = scene(text);
  ASSERT_EQ(s.sources.size(), 2u);
  EXPECT_NEAR(s.sources[0].count, 800, 1e-9);
  EXPECT_NEAR(s.sources[1].count, 100, 1e-9);
  EXPECT_EQ(s.sources[1].type, 2);
}

/// A pack that fills up its region does so at every insertion, whatever tells how full.
TEST_F(DeckInsertion, ARegionIsFilledAgain)
{
  const double ball = 4.0 / 3.0 * M_PI * 8e-9;
  for (const std::string& full :
       {std::string("particles_in_region 100"), "mass_in_region " + std::to_string(1e5 * ball)}) {
    std::string text = falling("", full + " region bc");
    EXPECT_NEAR(scene(text).count(), 100, 0.2) << full;  // six digits of the mass
    text.replace(text.find("insert_every once"), 17, "insert_every 400 ");
    EXPECT_NEAR(scene(text).count(), 300, 0.6) << full;  // at steps 0, 400, 800
  }
}

TEST_F(DeckInsertion, TheLargestSpeedCounts)
{
  const auto speed = [&](const std::string& velocity) {
    std::string text = falling("");
    const std::string constant = "constant 0 0 -0.5";
    return scene(text.replace(text.find(constant), constant.size(), velocity)).sources.at(0).speed;
  };
  EXPECT_EQ(speed("constant 0 3 -4"), 5);
  EXPECT_EQ(speed("uniform 0 0 -4 3 0 0"), 5);
  EXPECT_EQ(speed("gaussian 0 0 -4 1 0 0"), 5);  // three sigma
}

TEST_F(DeckInsertion, WhatIsNotFollowedIsAskedFor)
{
  const Scene none = scene(falling("", "region bc"));
  EXPECT_TRUE(holds(none.unknown_particles, {"how many particles is not understood"}));
  const Scene unknown = scene(falling("", "nparticles many region bc"));
  EXPECT_TRUE(holds(unknown.unknown_particles, {"particles are not known", "'many'"}));
  std::string text = falling("");
  text.replace(text.find("distributiontemplate d"), 22, "distributiontemplate dd");
  EXPECT_TRUE(holds(scene(text).notes, {"no particledistribution 'dd' is known", "did you mean 'd'?"}));
  text = falling("");
  text.replace(text.find("1 1 p 1.0"), 9, "1 1 pp 1.0");
  EXPECT_TRUE(holds(scene(text).notes, {"no particletemplate 'pp' is known", "did you mean 'p'?"}));
}

}  // namespace
}  // namespace granulaw::deck
