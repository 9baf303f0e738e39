#include "deck/commands/regions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckRegions = Deck;

TEST_F(DeckRegions, KnowsEveryRegion)
{
  struct Case
  {
    std::string text;
    double volume;
    Vec3 low, high;
  };
  const double cone = M_PI / 3 * (0.03 * 0.03 + 0.03 * 0.06 + 0.06 * 0.06) * 0.1;
  const std::string two =
      "region a block 0 0.3 0 0.2 0.1 0.2 units box\nregion b block 0.1 0.5 -0.2 0.1 0 0.15 units "
      "box\nregion r ";
  for (const Case& c :
       {Case{"region r block 0 0.1 -0.2 0.2 0.3 0.4 units box", 0.004, {0, -0.2, 0.3}, {0.1, 0.2, 0.4}},
        Case{"region r block EDGE 0 -0.5 EDGE INF INF units box", 1.5, {-1, -0.5, 0}, {0, 1, 1}},
        Case{"region r cylinder x 0.1 0.5 0.05 0.2 0.4 units box",
             M_PI * 0.0005,
             {0.2, 0.05, 0.45},
             {0.4, 0.15, 0.55}},
        Case{"region r cylinder y 0.1 0.5 0.05 0.2 0.4 units box",
             M_PI * 0.0005,
             {0.05, 0.2, 0.45},
             {0.15, 0.4, 0.55}},
        Case{"region r cone z 0.1 0.2 0.03 0.06 0.5 0.6 units box",
             cone,
             {0.04, 0.14, 0.5},
             {0.16, 0.26, 0.6}},
        Case{"region r sphere 0.1 0.2 0.5 0.1 units box",
             4.0 / 3.0 * M_PI * 1e-3,
             {0, 0.1, 0.4},
             {0.2, 0.3, 0.6}},
        Case{two + "union 2 a b", 0.3 * 0.2 * 0.1 + 0.4 * 0.3 * 0.15, {0, -0.2, 0}, {0.5, 0.2, 0.2}},
        Case{two + "intersect 2 a b", 0.2 * 0.1 * 0.05, {0.1, 0, 0.1}, {0.3, 0.1, 0.15}}}) {
    std::string text = falling("", "volumefraction_region 0.3 region r");
    text.insert(text.find("fix m1"), c.text + "\n");
    const Scene s = scene(text);
    ASSERT_EQ(s.sources.size(), 1u) << c.text;
    EXPECT_NEAR(s.count() / (0.3 * c.volume / (4.0 / 3.0 * M_PI * 8e-9)), 1, 1e-12) << c.text;  // rounding
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(s.sources[0].centres.low[k], c.low[k], 1e-15) << c.text;
      EXPECT_NEAR(s.sources[0].centres.high[k], c.high[k], 1e-15) << c.text;
    }
  }
}

/// Whatever command asks for it: it is not made up, and the note names the nearest one.
TEST_F(DeckRegions, AnUnknownOneIsNamedWithTheNearest)
{
  for (const std::string line :
       {"region both union 2 bin funel", "region both intersect 2 funel bin", "create_box 1 funel",
        "create_atoms 1 region funel", "create_atoms 1 random 10 1 funel",
        "fix i all insert/pack seed 1 distributiontemplate d nparticles 5 region funel"}) {
    const Scene s = scene(
        "units si\nregion funnel block 0 1 0 1 0 1 units box\nregion bin sphere 0 0 0 1 units box\n" + line);
    ASSERT_EQ(s.notes.size(), 1u) << line;
    EXPECT_TRUE(holds(s.notes, {"in.deck:4", "no region 'funel' is known", "did you mean 'funnel'?"}))
        << s.notes[0];
    EXPECT_TRUE(s.sources.empty()) << line;
    EXPECT_TRUE(s.domain.empty()) << line;
    const bool brings_particles = line.starts_with("create_atoms") || line.starts_with("fix");
    EXPECT_EQ(s.unknown_particles.size(), brings_particles ? 1u : 0u) << line;
  }
}

TEST_F(DeckRegions, AnUnknownStyleIsNamedWithTheNearest)
{
  const Scene s = scene("units si\nregion r sphera 0 0 0 1 units box\nregion w wedge axis z 0 0 1 0 90 0 1");
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "'sphera'", "did you mean 'sphere'?"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "--drop-height"}));
}

/// What lies outside may lie anywhere in the domain.
TEST_F(DeckRegions, OutsideIsTheWholeDomain)
{
  std::string text = falling("", "volumefraction_region 0.3 region r");
  text.insert(text.find("fix m1"), "region r sphere 0 0 0.5 0.1 side out units box\n");
  EXPECT_EQ(scene(text).sources[0].centres.low, (Vec3{-1, -1, 0}));
}

}  // namespace
}  // namespace granulaw::deck
