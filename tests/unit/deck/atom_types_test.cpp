#include "deck/atom_types.hpp"

#include <gtest/gtest.h>

#include "deck/plan_options.hpp"

namespace granulaw::deck::atom_types_test {

Source source(int type, double radius_min, double radius_max, double density)
{
  Source s;
  s.where = "in.deck:9";
  s.type = type;
  s.radius_min = radius_min;
  s.radius_max = radius_max;
  s.density = density;
  return s;
}

Scene two_types()
{
  Scene s;
  s.deck = "in.deck";
  s.materials[1] = {2e9, 0.2, 5e6};
  s.materials[2] = {3e9, 0.3, {}};
  s.sources = {source(1, 0.002, 0.003, 900), source(1, 0.001, 0.002, 1000), source(2, 0.004, 0.004, 2000)};
  return s;
}

TEST(AtomTypes, HoldTheParticlesOfAllTheirSources)
{
  std::vector<Question> questions;
  const auto types = particle_types(two_types(), {}, questions);
  EXPECT_TRUE(questions.empty());
  ASSERT_EQ(types.size(), 2u);
  const AtomType& one = types.at(1);
  EXPECT_EQ(one.radius_min, 0.001);
  EXPECT_EQ(one.radius_max, 0.003);
  EXPECT_EQ(one.density, 1000);
  EXPECT_EQ(one.material.youngs_modulus, 2e9);
  EXPECT_EQ(one.material.yield_stress, 5e6);
  EXPECT_TRUE(one.known_yield);
  EXPECT_FALSE(types.at(2).known_yield);
}

TEST(AtomTypes, ANamedMaterialTakesThePlaceOfTheDecks)
{
  PlanOptions options;
  options.materials[2] = {"wax", 0, 91e6, 0.3, 1e6, 0};
  std::vector<Question> questions;
  const auto types = particle_types(two_types(), options, questions);
  EXPECT_EQ(types.at(2).material.name, "wax");
  EXPECT_EQ(types.at(2).material.density, 2000);  // the deck's, as wax has none
  EXPECT_TRUE(types.at(2).known_yield);
}

TEST(AtomTypes, AskForWhatIsMissing)
{
  const auto asked = [](const Scene& s, const PlanOptions& options) {
    std::vector<Question> questions;
    particle_types(s, options, questions);
    std::string options_asked;
    for (const Question& q : questions) options_asked += q.option.substr(0, q.option.find(' ')) + " ";
    return options_asked;
  };
  Scene s = two_types();
  s.sources[0].radius_max = 0;
  EXPECT_EQ(asked(s, {}), "--radius ");
  s = two_types();
  s.sources[2].density = 0;
  EXPECT_EQ(asked(s, {}), "--density ");
  PlanOptions options;
  options.density = 500;
  EXPECT_EQ(asked(s, options), "");
  s = two_types();
  s.materials.erase(2);
  EXPECT_EQ(asked(s, {}), "--materials-file ");
  s = two_types();
  s.unknown_particles = {"in.deck:3: read_restart"};
  EXPECT_EQ(asked(s, {}), "--radius ");
  s.sources.clear();
  EXPECT_EQ(asked(s, {}), "--radius ");
  s.unknown_particles.clear();
  EXPECT_EQ(asked(s, {}), "--radius ");
  std::vector<Question> questions;
  EXPECT_FALSE(wall_type(s, 3, {}, questions));
  EXPECT_EQ(questions.size(), 1u);
  EXPECT_EQ(wall_type(s, 2, {}, questions)->material.youngs_modulus, 3e9);
}

TEST(AtomTypes, GivenRadiiStandForHiddenParticles)
{
  Scene s = two_types();
  s.unknown_particles = {"in.deck:3: read_restart"};
  PlanOptions options;
  options.radius_min = 0.0005;
  options.radius_max = 0.01;
  std::vector<Question> questions;
  const auto types = particle_types(s, options, questions);
  EXPECT_TRUE(questions.empty());
  for (const int type : {1, 2}) {
    EXPECT_EQ(types.at(type).radius_min, 0.0005);
    EXPECT_EQ(types.at(type).radius_max, 0.01);
  }
}

}  // namespace granulaw::deck::atom_types_test
