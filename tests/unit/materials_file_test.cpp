// Particles in MATERIALS.toml: the documentation's examples, and what is refused.
#include "material_file/materials_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "scratch_folder.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::materials_file_test {

using std::numbers::pi;

class MaterialsFileTest : public ScratchFolder
{
 protected:
  MaterialsFile read(const std::string& text) const { return read_materials(write("m.toml", text)); }
  const std::string path_ = path("m.toml");
};

/// All ```toml blocks of docs/guide/particles.md, one after the other.
std::string documented()
{
  std::ifstream file(GRANULAW_SOURCE_DIR "/docs/guide/particles.md");
  std::string line, text;
  bool inside = false;
  while (std::getline(file, line)) {
    if (line.starts_with("```"))
      inside = line == "```toml";
    else if (inside)
      text += line + "\n";
  }
  return text;
}

TEST_F(MaterialsFileTest, DocumentedExamplesAreWhatTheySay)
{
  const MaterialsFile file = read(documented());
  std::set<std::string> names;
  for (const auto& entry : file.particles) names.insert(entry.first);
  EXPECT_EQ(names,
            (std::set<std::string>{"coated", "drop", "egg", "grain", "pill", "speckled", "spindle", "worn"}));

  EXPECT_EQ(file.particle("grain").radius, 2e-3);
  EXPECT_EQ(file.particle("grain").materials.at(0).density, 1500);
  EXPECT_TRUE(file.particle("grain").is_homogeneous_sphere());

  const Particle& coated = file.particle("coated");
  EXPECT_EQ(coated.materials[coated.material_at(0, 10e-6)].density, 2500);
  EXPECT_EQ(coated.materials[coated.material_at(0, 40e-6)].density, 7800);
  EXPECT_EQ(coated.materials[coated.material_at(0, 100e-6)].density, 1500);

  const Particle& speckled = file.particle("speckled");
  EXPECT_EQ(speckled.materials.size(), 3u);
  EXPECT_EQ(speckled.materials[speckled.material_at(0, 2e-3)].density, 7800);
  EXPECT_EQ(speckled.material_at(0, 0.1e-3), -1);
  EXPECT_EQ(speckled.materials[speckled.material_at(1.45e-3, 2e-3)].density, 2500);
  EXPECT_EQ(speckled.materials[speckled.material_at(0, 1e-3)].density, 1500);

  // 4e-6, 3e-5: chord error and fit, see particle_test.cpp
  EXPECT_NEAR(file.particle("egg").volume() / (4.0 / 3.0 * pi * 8e-9 * 1.5), 1, 4e-6);
  EXPECT_NEAR(file.particle("egg").pole_curvature_radius() / (2e-3 / 1.5), 1, 3e-5);
  EXPECT_EQ(file.particle("worn").profile.size(), flattened_sphere(2e-3, 0.3e-3, 0.05e-3).size());
  EXPECT_NEAR(file.particle("drop").height(), 0.2e-3 + 1.8e-3 / std::sin(40 * pi / 180) + 2e-3, 1e-15);
  EXPECT_EQ(file.particle("pill").height(), 4e-3);
  EXPECT_EQ(file.particle("pill").layers.size(), 1u);
  EXPECT_EQ(file.particle("spindle").radius, 1e-3);
}

constexpr const char* head =
    "[material.powder]\ndensity = 1500\nyoungs_modulus = 9.1e9\npoisson_ratio = 0.3\n"  // lines 1 to 4
    "[particle.grain]\n";                                                               // line 5

constexpr const char* frictional =
    "[material.m]\ndensity = 1500\nyoungs_modulus = 9e9\npoisson_ratio = 0.3\nyield_stress = "
    "5e7\nyield_surface = ";

TEST_F(MaterialsFileTest, YieldSurfaces)
{
  const MaterialsFile file = read(std::string(frictional) +
                                  "{kind = \"drucker-prager\", friction_angle = 30, dilatancy_angle = 10}\n");
  const FlowLaw& surface = file.material("m").yield_surface;
  EXPECT_EQ(surface.name, "drucker-prager");
  EXPECT_EQ(surface.values.at("friction_angle"), std::vector<double>{30});
  EXPECT_EQ(surface.values.at("dilatancy_angle"), std::vector<double>{10});
}

TEST_F(MaterialsFileTest, YieldSurfacesThatCannotBeUsed)
{
  const auto refused = [&](const std::string& surface, const char* part) {
    expect_error(part, [&] { read(frictional + surface + "\n"); });
  };
  refused("{kind = \"druker-prager\"}", ":6: [material.m.yield_surface]: no yield surface 'druker-prager'");
  refused("{kind = \"drucker-prager\", friction_angle = 30}", "the key 'dilatancy_angle' is missing");
  refused("{kind = \"drucker-prager\", friction_angle = 30, dilatancy_angle = 10, cohesion = 1}", "unknown key 'cohesion'");
  refused("{kind = \"drucker-prager\", friction_angle = 90, dilatancy_angle = 10}", "0 to 75");
  refused("{kind = \"drucker-prager\", friction_angle = 10, dilatancy_angle = 30}", "is larger than");
}

TEST_F(MaterialsFileTest, UnknownParticleIsNamedWithTheNearest)
{
  const std::string sphere = std::string(head) + "radius = 1e-3\nmaterial = \"powder\"\n";
  EXPECT_EQ(sentence_of([&] { read(sphere).particle("grian"); }),
            path_ + ": no particle 'grian' (did you mean 'grain'?): allowed is grain");
}

TEST_F(MaterialsFileTest, ParticlesThatCannotBeUsed)
{
  const std::string body = "radius = 1e-3\nmaterial = \"powder\"\n";  // lines 6 and 7
  const struct
  {
    std::string text, sentence;
  } cases[] = {
      {"material = \"powder\"", ":5: [particle.grain]: the key 'radius' is missing"},
      {"radius = 1e-3", ":5: [particle.grain]: the key 'material' is missing"},
      {body + "layer = []", ":8: [particle.grain]: unknown key 'layer' (did you mean 'layers'?): allowed is"},

      {body + "layers = 3", ":8: [particle.grain]: 'layers' must be a list of tables, such as [{material ="},
      {body + "layers = [3]", ":8: [particle.grain]: 'layers' must be a list of tables"},
      {body + "layers = [\n{material = \"powder\", thicknes = 1e-5}]",
       ":9: [particle.grain.layers 1]: unknown key 'thicknes' (did you mean 'thickness'?)"},
      {body + "layers = [{material = \"powder\"}]",
       ":8: [particle.grain.layers 1]: the key 'thickness' is missing"},
      {body +
           "layers = [{material = \"powder\", thickness = 1e-5},\n {material = \"powdr\", thickness = 1e-5}]",
       ":9: [particle.grain.layers 2]: no material 'powdr' (did you mean 'powder'?): allowed is powder"},
      {body + "layers = [{material = \"powder\", thickness = 0}]",
       ":8: [particle.grain.layers 1]: 'thickness' is out of range: found 0 m, allowed is over 0 m"},
      {body + "layers = [{material = \"powder\", thickness = 1e-3}]",
       ":5: [particle.grain]: the layers leave no core: they are thicker than the body is deep: found 0.001 "
       "m, "
       "allowed is below 0.001 m"},

      {body + "inclusions = [{radius = 1e-4, z = 1e-3}]",
       ":8: [particle.grain.inclusions 1]: an inclusion needs one of 'material' and 'pore = true': found "
       "none"},
      {body + "inclusions = [{pore = true, material = \"powder\", radius = 1e-4, z = 1e-3}]",
       ":8: [particle.grain.inclusions 1]: an inclusion needs one of 'material' and 'pore = true': found "
       "both"},
      {body + "inclusions = [{pore = false, radius = 1e-4, z = 1e-3}]",
       ":8: [particle.grain.inclusions 1]: 'pore' cannot be used: allowed is pore = true, or no such key"},
      {body + "inclusions = [{pore = true, radius = 1e-4}]",
       ":8: [particle.grain.inclusions 1]: the key 'z' is missing"},
      {body + "inclusions = [{pore = true, radius = \"big\", z = 1e-3}]",
       ":8: [particle.grain.inclusions 1]: 'radius' must be a number in m"},
      {body + "inclusions = [{pore = true, radius = 1e-4, depth = 1e-3}]",
       ":8: [particle.grain.inclusions 1]: unknown key 'depth': allowed is material, pore, radius, z, r"},
      {body + "inclusions = [{pore = true, radius = 1e-4, z = 0.5e-4}]",
       ":5: [particle.grain]: inclusion 1 reaches the surface: its radius: found 0.0001 m, allowed is below "
       "5e-05 m"},

      {body + "profile = \"ellipsoid\"", ":8: [particle.grain]: 'profile' must be a table, such as {shape ="},
      {body + "profile = {aspect = 2}", ":8: [particle.grain.profile]: the key 'shape' is missing"},
      {body + "profile = {shape = \"elipsoid\", aspect = 2}",
       ":8: [particle.grain.profile]: no shape 'elipsoid' (did you mean 'ellipsoid'?): allowed is ellipsoid, "
       "flattened-sphere, conical-tip, tablet, or points = [[r, z], ...]"},
      {body + "profile = {shape = \"ellipsoid\"}",
       ":8: [particle.grain.profile]: the key 'aspect' is missing"},
      {body + "profile = {shape = \"ellipsoid\", aspct = 2}",
       ":8: [particle.grain.profile]: unknown key 'aspct' (did you mean 'aspect'?): allowed is shape, "
       "aspect"},
      {body + "profile = {shape = \"ellipsoid\", aspect = 21}",
       ":8: [particle.grain.profile]: 'aspect' is out of range: found 21, allowed is 0.05 to 20"},
      {body + "profile = {shape = \"conical-tip\", half_angle = 90, tip_radius = 1e-4}",
       ":8: [particle.grain.profile]: 'half_angle' is out of range: found 90 degrees, allowed is 5 to 85 "
       "degrees"},
      {body + "profile = {shape = \"flattened-sphere\", flat_radius = 0}",
       ":8: [particle.grain.profile]: 'flat_radius' is out of range: found 0 m, allowed is over 0 m"},
      {body + "profile = {shape = \"flattened-sphere\", flat_radius = 0.95e-3}",
       ":8: [particle.grain.profile]: 'flat_radius' and 'fillet' leave no sphere"},
      {"material = \"powder\"\nprofile = {shape = \"ellipsoid\", aspect = 2}",
       ":5: [particle.grain]: the key 'radius' is missing"},

      {body + "profile = {shape = \"ellipsoid\", points = [[0, 0], [1e-3, 1e-3], [0, 2e-3]]}",
       ":8: [particle.grain.profile]: unknown key 'shape': allowed is points"},
      {body + "profile = {points = []}",
       ":8: [particle.grain.profile]: 'points' must be a list of pairs, such as [[0, 0]"},
      {body + "profile = {points = [[0, 0], [1e-3, 1e-3, 0], [0, 2e-3]]}",
       ":8: [particle.grain.profile]: entry 2 of 'points' is not a pair of numbers"},
      {body + "profile = {points = [[0, 0], [1e-3, 1e-3]]}",
       ":8: [particle.grain.profile]: the points enclose no body: found 2 points, allowed is 3 or more"},
      {body + "profile = {points = [[0, 0], [0.9e-3, 1e-3], [0, 2e-3]]}",
       ":6: [particle.grain]: 'radius' is not the largest r of the points, to 1 %: found 0.001 m, allowed is "
       "0.0009 m, or no radius"},
      {body + "profile = {points = [[0, 0], [1e-3, 1e-3], [0.1e-3, 2e-3]]}",
       ":8: [particle.grain.profile]: the last point must lie on the axis, at the far pole"},
      {body + "profile = {points = [[0, 0], [1e-3, 1e-3], [1e-3, 0.5e-3], [0.3e-3, 1.5e-3], [0, 2e-3]]}",
       ":5: [particle.grain]: the profile crosses or touches itself"},
  };
  for (const auto& [text, sentence] : cases) {
    const std::string found = sentence_of([&] { read(head + text + "\n"); });
    EXPECT_TRUE(found.starts_with(path_ + sentence)) << "wanted: " << sentence << "\nfound:  " << found;
  }
  // an outline whose radius agrees to 1 % is taken as drawn
  EXPECT_EQ(read(head + body + "profile = {points = [[0, 0], [0.995e-3, 1e-3], [0, 2e-3]]}")
                .particle("grain")
                .radius,
            0.995e-3);
}

}  // namespace granulaw::materials_file_test
