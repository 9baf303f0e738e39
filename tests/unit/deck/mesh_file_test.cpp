#include "deck/mesh_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/error.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckMeshFile = Deck;

TEST_F(DeckMeshFile, ReadsMeshes)
{
  const std::string text = write("a.stl",
                                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                 "vertex 0 2 3\nendloop\nendfacet\nendsolid a\n");
  std::string binary(80, ' ');
  binary.replace(0, 5, "solid");  // some writers begin so
  const std::uint32_t one = 1;
  binary.append(reinterpret_cast<const char*>(&one), 4);
  const float triangle[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 3};
  binary.append(reinterpret_cast<const char*>(triangle), sizeof triangle);
  binary.append(2, '\0');
  for (const std::string& path : {text, write("b.stl", binary)}) {
    Box box;
    for (const Vec3& p : mesh_vertices(path)) box.include(p);
    EXPECT_EQ(box.low, (Vec3{0, 0, 0}));
    EXPECT_EQ(box.high, (Vec3{1, 2, 3}));
  }
  EXPECT_THROW(mesh_vertices(write("c.stl", "no mesh")), Error);
  EXPECT_THROW(mesh_vertices(write("d.stl", "vertex 1 nan")), Error);
}

}  // namespace
}  // namespace granulaw::deck
