#include "deck/commands/walls.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"
#include "liggghts_plugin/deck_keywords.hpp"

namespace granulaw::deck {
namespace {

using DeckWalls = Deck;

TEST_F(DeckWalls, KnowsEveryPrimitive)
{
  const auto wall = [&](const std::string& words) {
    return scene(
               "units si\nregion r block -1 1 -2 2 -3 3 units box\ncreate_box 2 r\nfix w all wall/gran model "
               "hertz "
               "primitive type 2 " +
               words)
        .walls.at(0);
  };
  const Vec3 low{-1, -2, -3}, high{1, 2, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis(1, static_cast<char>('x' + k));
    Vec3 plane_low = low, plane_high = high;
    plane_low[k] = plane_high[k] = 0.5;
    EXPECT_EQ(wall(axis + "plane 0.5").box.low, plane_low);
    EXPECT_EQ(wall(axis + "plane 0.5").box.high, plane_high);
    Vec3 tube_low{0.7, 0.7, 0.7}, tube_high{0.9, 0.9, 0.9};  // radius 0.1 about 0.8
    tube_low[k] = low[k];
    tube_high[k] = high[k];
    const Box tube = wall(axis + "cylinder 0.1 0.8 0.8").box;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(tube.low[c], tube_low[c], 1e-15);
      EXPECT_NEAR(tube.high[c], tube_high[c], 1e-15);
    }
  }
  EXPECT_EQ(wall("zplane 0 shear x -0.3").drag_speed, 0.3);
  EXPECT_EQ(wall("zplane 0").type, 2);
}

TEST_F(DeckWalls, OthersAreNamed)
{
  const Scene s = scene(
      "units si\nfix w all wall/reflect zlo\nfix v all wall/gran model hertz primitive type 1 cone 1\n"
      "fix u all wall/gran model hertz\nfix t all wall/gran mesh n_meshes 1\n");
  EXPECT_TRUE(holds(s.notes, {"in.deck:2", "wall/reflect", "only wall/gran is read"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:3", "only planes and cylinders"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:4", "neither 'mesh' nor 'primitive'"}));
  EXPECT_TRUE(holds(s.notes, {"in.deck:5", "'meshes' is missing"}));
}

/// `wall deformable` is read wherever it stands among the plug-in's keywords.
TEST_F(DeckWalls, UnderstandsEveryKeywordOfThePlugin)
{
  const auto deformable = [&](const std::string& keywords) {
    return scene("units si\nfix w all wall/gran primitive type 2 zplane 0 model mpm tangential history " +
                 keywords)
        .walls.at(0)
        .deformable;
  };
  for (const plugin::Keyword& k : plugin::keyword_table) {
    if (!k.in_wall || k.name == "wall") continue;
    const std::string other = std::string(k.name) + " on";
    EXPECT_TRUE(deformable(other + " wall deformable")) << k.name;
    EXPECT_TRUE(deformable("wall deformable " + other)) << k.name;
    EXPECT_FALSE(deformable(other + " wall rigid")) << k.name;
    EXPECT_FALSE(deformable(other)) << k.name;
  }
}

}  // namespace
}  // namespace granulaw::deck
