#include "characterise/body/materials.hpp"

#include "scratch_folder.hpp"
#include "some_materials.hpp"

namespace granulaw::materials_test {

TEST(Materials, AreFoundByName)
{
  const Materials m = some_materials();
  EXPECT_EQ(m.material("glass").density, 2500);
  EXPECT_EQ(m.particle("grain").radius, 2e-3);
  EXPECT_EQ(names_of(m.materials), (std::vector<std::string>{"glass", "powder", "stronger"}));
}

TEST(Materials, AMaterialGoesBeforeAParticleOfItsName)
{
  Materials m = some_materials();
  EXPECT_TRUE(m.means_particle("grain"));
  EXPECT_FALSE(m.means_particle("powder"));
  m.materials["grain"] = glass();
  EXPECT_FALSE(m.means_particle("grain"));
  EXPECT_FALSE(m.means_particle("nothing"));
}

TEST(Materials, UnknownNamesAreAnsweredWithTheNearest)
{
  const Materials m = some_materials();
  expect_error("test: no material 'glas' (did you mean 'glass'?)", [&] { m.material("glas"); });
  expect_error("no particle 'grian' (did you mean 'grain'?)", [&] { m.particle("grian"); });
  expect_error("no material or particle 'grian' (did you mean 'grain'?)", [&] { m.require("grian"); });
  EXPECT_EQ(sentence_of([&] { m.require("grain"), m.require("powder"); }), "");
  expect_error("defines none", [] { Materials{"none", {}, {}}.particle("x"); });
}

}  // namespace granulaw::materials_test
