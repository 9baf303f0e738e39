// Three-dimensional shapes in MATERIALS.toml: the documentation's examples, and what is refused.
#include "material_file/shape_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "material_file/materials_file.hpp"
#include "scratch_folder.hpp"

namespace granulaw::shape_reader_test {

namespace fs = std::filesystem;

/// A folder of its own for each test, with the files that the shapes name.
class ShapeReader : public ScratchFolder
{
 protected:
  void SetUp() override
  {
    ScratchFolder::SetUp();
    for (const char* name : {"grain.stl", "grain.clump"})
      fs::copy_file(fs::path(GRANULAW_SOURCE_DIR "/examples/irregular") / name, path(name));
  }

  MaterialsFile read(const std::string& text) const { return read_materials(write("m.toml", text)); }
  /// Message about [particle.grain] with these lines, from line 6 on; without the folder.
  std::string sentence(const std::string& lines) const
  {
    const std::string said = sentence_of([&] {
      read("[material.powder]\ndensity = 1500\nyoungs_modulus = 9.1e9\npoisson_ratio = 0.3\n[particle.grain]\n" +
           lines + "\nmaterial = \"powder\"\n")
          .particle("grain");
    });
    return said.empty() ? "accepted" : said.substr(path("").size());
  }
};

TEST_F(ShapeReader, DocumentedExamplesAreWhatTheySay)
{
  std::ifstream page(GRANULAW_SOURCE_DIR "/docs/guide/shapes.md");
  std::string line, text;
  for (bool inside = false; std::getline(page, line);) {
    if (line.starts_with("```"))
      inside = line == "```toml";
    else if (inside)
      text += line + "\n";
  }
  const MaterialsFile file = read(text);
  const auto kind = [&](const char* name) { return std::string(file.particle(name).shape->kind()); };
  EXPECT_EQ(kind("ball"), "sphere");
  EXPECT_EQ(kind("pebble"), "ellipsoid");
  EXPECT_EQ(kind("pill"), "superquadric");
  EXPECT_EQ(kind("salt"), "box");
  EXPECT_EQ(kind("shard"), "polyhedron");
  // Their files have the volume of a sphere of radius 1; the clump is inscribed.
  EXPECT_NEAR(file.particle("stone").radius, 3e-3, 1e-8);
  EXPECT_NEAR(file.particle("clump").radius / 3e-3, 0.95, 0.03);
  EXPECT_NEAR(file.particle("pebble").radius, std::cbrt(1e-9 * 1.2 * 1.5), 1e-15);
  EXPECT_EQ(file.particle("porous").layers.size(), 1u);
  EXPECT_EQ(file.particle("porous").inclusions.at(0).x, 0.8e-3);
  EXPECT_FALSE(file.particle("ball").is_sphere());
}

TEST_F(ShapeReader, TheClumpOfTheExampleIsItsMesh)
{
  const MaterialsFile file = read(
      "[material.a]\ndensity = 1000\nyoungs_modulus = 1e9\npoisson_ratio = 0\n[particle.mesh]\nmaterial = "
      "\"a\"\nshape = {kind = "
      "\"mesh\", file = \"grain.stl\"}\n[particle.clump]\nmaterial = \"a\"\nshape = {kind = \"clump\", file "
      "= \"grain.clump\"}\n");
  const Shape &mesh = *file.particle("mesh").shape, &clump = *file.particle("clump").shape;
  // The clump's spheres touch the mesh's vertices from inside, so that they stand out of its chords by less
  // than a hundredth; make_grain.py says how far it lies inside at most.
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(-1, 0, 0)}) {
    Vector3 where;
    clump.support(n, &where);
    EXPECT_GT(mesh.depth(where), -0.01);
    EXPECT_LT(mesh.depth(where), 0.233);
  }
  EXPECT_LT((mesh.mass_properties().centre - clump.mass_properties().centre).norm(), 0.05);
}

TEST_F(ShapeReader, ParticlesThatCannotBeUsed)
{
  write("bad.clump", "0 0 0 1\n# a comment\n\n1 0 0\n");
  write("apart.clump", "0 0 0 1\n3 0 0 1\n");
  write("open.stl", "facet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n");
  const struct
  {
    std::string text, sentence;
  } cases[] = {
      {"shape = \"sphere\"",
       "m.toml:6: [particle.grain]: 'shape' must be a table, such as {kind = \"ellipsoid\", axes = [1e-3, "
       "1e-3, 1.5e-3]}"},
      {"shape = {kind = \"elipsoid\"}",
       "m.toml:6: [particle.grain.shape]: no kind of shape 'elipsoid' (did you mean "
       "'ellipsoid'?): allowed is sphere, ellipsoid, superquadric, box, polyhedron, clump, mesh"},
      {"shape = {kind = \"ellipsoid\", axis = [1, 2, 3]}",
       "m.toml:6: [particle.grain.shape]: unknown key 'axis' (did you mean 'axes'?): allowed is kind, axes"},
      {"shape = {kind = \"ellipsoid\", axes = [1, 2]}",
       "m.toml:6: [particle.grain.shape]: 'axes' must hold three lengths, along x, y and z: found 2 numbers, "
       "allowed is 3"},
      {"shape = {kind = \"ellipsoid\", axes = [1, 2, 0]}",
       "m.toml:6: [particle.grain.shape]: 'axes' is out of range: found [1, 2, 0] m, allowed is over 0 m"},
      {"shape = {kind = \"ellipsoid\", axes = [1, 2, 200]}",
       "m.toml:6: [particle.grain.shape]: 'axes' makes the body too flat or too slender: found [1, 2, 200] "
       "m, allowed is "
       "lengths up to 100 times each other"},
      {"shape = {kind = \"superquadric\", axes = [1, 2, 3]}",
       "m.toml:6: [particle.grain.shape]: the key 'exponents' is missing"},
      {"shape = {kind = \"superquadric\", axes = [1, 2, 3], exponents = [1.5, 2]}",
       "m.toml:6: [particle.grain.shape]: 'exponents' is out of range: found [1.5, 2], allowed is 2 to 20"},
      {"shape = {kind = \"box\", sides = [1, 2, 3], edge_radius = 0.6}",
       "m.toml:6: [particle.grain.shape]: 'edge_radius' does not fit the sides: found 0.6 m, allowed is "
       "0.001 to 0.5 m, a "
       "thousandth to half of the shortest side"},
      {"shape = {kind = \"polyhedron\", corners = [[0, 0, 0], [1, 0, 0], [0, 1]], edge_radius = 0.1}",
       "m.toml:6: [particle.grain.shape]: entry 3 of 'corners' is not 3 finite numbers: allowed is [[0, 0, "
       "0], [1e-3, 0, 0], "
       "...] in m"},
      {"shape = {kind = \"polyhedron\", corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], edge_radius "
       "= 0.1}",
       "m.toml:6: [particle.grain.shape]: the corners span no volume: they lie in one plane"},
      {"shape = {kind = \"clump\", file = \"none.clump\"}", "none.clump: the clump's file cannot be read"},
      {"shape = {kind = \"clump\", file = \"bad.clump\"}",
       "bad.clump:4: is no sphere of a clump: found 1 0 0, allowed is four numbers: x y z r"},
      {"shape = {kind = \"clump\", file = \"apart.clump\"}",
       "apart.clump: the spheres of the clump do not hang together: found no overlap with the sphere at (3, "
       "0, 0) m, r = 1 m, "
       "allowed is one body of overlapping spheres"},
      {"shape = {kind = \"mesh\", file = \"open.stl\"}",
       "open.stl: the mesh encloses no body: found 1 triangles, allowed is 4 or more"},
      {"shape = {kind = \"mesh\", file = \"bad.clump\"}",
       "bad.clump: is no mesh: found no triangles, allowed is STL, text or binary"},
      {"shape = {kind = \"mesh\", file = \"grain.stl\", scale = 0}",
       "m.toml:6: [particle.grain.shape]: 'scale' is out of range: found 0, allowed is over 0"},
      {"radius = 1\nshape = {kind = \"box\", sides = [1, 2, 3], edge_radius = 0.2}",
       "m.toml:6: [particle.grain]: 'radius' cannot go with this shape, which says its own size"},
      {"shape = {kind = \"sphere\", radius = 1}\nprofile = {shape = \"ellipsoid\", aspect = 2}",
       "m.toml:6: [particle.grain]: a particle has a 'shape' or a 'profile', not both"},
      {"shape = {kind = \"sphere\", radius = 1}\ninclusions = [{pore = true, radius = 0.1, r = 0.3}]",
       "m.toml:7: [particle.grain.inclusions 1]: unknown key 'r': allowed is material, pore, radius, x, y, "
       "z"},
      {"radius = 1\nshape = {kind = \"sphere\"}", "accepted"},
  };
  for (const auto& c : cases) EXPECT_EQ(sentence(c.text), c.sentence) << c.text;
}

/// A file that a particle names stops those who use that particle; a wrong key stops all.
TEST_F(ShapeReader, AFaultyFileStopsNobodyElse)
{
  const std::string text =
      "[material.powder]\ndensity = 1500\nyoungs_modulus = 9.1e9\npoisson_ratio = 0.3\n"
      "[particle.ball]\nmaterial = \"powder\"\nradius = 1e-3\n"
      "[particle.scan]\nmaterial = \"powder\"\nshape = {kind = \"mesh\", file = \"none.stl\"}\n"
      "inclusions = [{pore = true, radius = 0.1, x = 0.3, y = 0";
  const MaterialsFile file = read(text + "}]\n");
  EXPECT_EQ(file.particle("ball").radius, 1e-3);
  EXPECT_EQ(file.material("powder").density, 1500);
  file.require("scan");
  expect_error("none.stl", [&] { file.particle("scan"); });
  expect_error("unknown key 'q'", [&] { read(text + ", q = 0}]\n"); });
}

}  // namespace granulaw::shape_reader_test
