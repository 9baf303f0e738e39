#include "deck/commands/meshes.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckMeshes = Deck;

TEST_F(DeckMeshes, ScaleMoveAndRotateActInTheOrderOfTheLine)
{
  write("a.stl", "vertex 0 0 0 vertex 1 0 0 vertex 0 2 3");
  const Scene s = scene(
      "units si\nregion r block -9 9 -9 9 -9 9 units box\ncreate_box 1 r\n"
      "fix m all mesh/surface file a.stl type 1 scale 2 move 1 0 0 rotate axis 0 0 1 angle 180\n"
      "fix w all wall/gran model hertz mesh n_meshes 1 meshes m");
  ASSERT_EQ(s.walls.size(), 1u);
  EXPECT_NEAR(s.walls[0].box.low[0], -3, 1e-14);
  EXPECT_NEAR(s.walls[0].box.high[2], 6, 1e-14);
}

TEST_F(DeckMeshes, SurfacesDrag)
{
  write("a.stl", "vertex 3 0 0 vertex 1 0 0 vertex 0 2 0");
  const auto wall = [&](const std::string& words) {
    return scene("units si\nfix m all mesh/surface file a.stl type 2 " + words +
                 "\nfix w all wall/gran model hertz mesh n_meshes 1 meshes m")
        .walls.at(0);
  };
  EXPECT_EQ(wall("surface_vel 0 3 4").drag_speed, 5);
  EXPECT_EQ(wall("surface_ang_vel origin 0 0 0 axis 0 0 1 omega -2").drag_speed, 6);  // 2/s at 3 m
  EXPECT_EQ(wall("").type, 2);
}

TEST_F(DeckMeshes, AnUnknownOneIsNamedWithTheNearest)
{
  write("a.stl", "vertex 0 0 0 vertex 1 0 0 vertex 0 2 3");
  const Scene s = scene(
      "units si\nfix hopper all mesh/surface file a.stl\nfix w all wall/gran mesh meshes hoper\n"
      "fix v all move/mesh mesh hoper linear 1 0 0\nfix n all mesh/surface type 1\n");
  for (const char* line : {"in.deck:3", "in.deck:4"})
    EXPECT_TRUE(holds(s.notes, {line, "no mesh 'hoper' is known", "did you mean 'hopper'?"})) << line;
  EXPECT_TRUE(holds(s.notes, {"in.deck:5", "file"}));
  EXPECT_TRUE(s.walls.empty());
}

}  // namespace
}  // namespace granulaw::deck
