#include "deck_options.hpp"

#include <cmath>

#include "deck/deck_fixture.hpp"
#include "law/contact_step.hpp"

namespace granulaw::deck_options_test {

/// 100 spheres that fall on a floor of another type.
deck::Scene powder_on_steel()
{
  deck::Scene s = deck::falling();
  s.domain = {{-0.05, -0.05, 0}, {0.05, 0.05, 0.5}};
  s.materials[1] = {9.1e9, 0.3, {}};
  s.materials[2] = {2e11, 0.3, {}};
  s.model = s.walls[0].model = "mpm";
  s.law_file = "law.h5";
  s.material_names = {"powder", "steel"};
  s.time_step = s.runs[0].time_step = 1e-6;
  deck::Source& spheres = s.sources[0];
  spheres.density = 1500;
  spheres.centres = s.domain;
  spheres.speed = 2;
  return s;
}

constexpr const char* materials_text =
    "[material.powder]\ndensity = 1500\nyoungs_modulus = 9.1e9\npoisson_ratio = 0.3\nyield_stress = 1e8\n";

class DeckOptionsTest : public ScratchFolder
{
 protected:
  void SetUp() override
  {
    ScratchFolder::SetUp();
    options_.materials_file = write("m.toml", materials_text);
  }
  PlannedDeck planned(const deck::Scene& scene = powder_on_steel()) const { return plan_scene(scene, options_); }
  DeckOptions options_;
};

TEST_F(DeckOptionsTest, MaterialsGoByTheDecksNames)
{
  const PlannedDeck d = planned();
  EXPECT_EQ(d.options.materials.at(1).yield_stress, 1e8);
  EXPECT_EQ(d.options.materials.at(2).name, "steel");  // not in the file: elastic, as the deck has it
  EXPECT_FALSE(d.options.materials.at(2).yields());
  EXPECT_EQ(d.plan.radius_max, 2e-3);
  EXPECT_GT(d.plan.depth, 0);
}

TEST_F(DeckOptionsTest, NamesMayBeGiven)
{
  options_.materials = {"powder", "steel"};
  EXPECT_EQ(planned().options.materials.at(1).name, "powder");
  options_.materials = {"x", "y"};
  expect_error("has no material for atom type 1 'x': allowed is powder", [&] { planned(); });
  options_.materials = {"powder", "steel", "powder"};
  expect_error("--materials: more names than the deck's 2 atom types", [&] { planned(); });
  options_.materials_file = "";
  expect_error("--materials-file FILE", [&] { planned(); });
}

/// A type that particles have is not elastic because a file lacks its name; one of rigid walls may be.
TEST_F(DeckOptionsTest, ParticlesNeedTheirMaterial)
{
  const auto with_names = [](std::vector<std::string> names) {
    deck::Scene s = powder_on_steel();
    s.material_names = std::move(names);
    return s;
  };
  expect_error("'materials' of pair_style: " + options_.materials_file +
                   " has no material for atom type 1 'powdr' (did you mean 'powder'?): allowed is powder",
               [&] { planned(with_names({"powdr", "steel"})); });
  // the plug-in's own word for a type without yield
  const PlannedDeck elastic = planned(with_names({"elastic", "steel"}));
  EXPECT_FALSE(elastic.options.materials.at(1).yields());
  EXPECT_EQ(elastic.plan.pairs.back().overlap_basis, "Hertz");
  // a wall that gives way has a material, too
  deck::Scene soft = powder_on_steel();
  soft.walls[0].deformable = true;
  expect_error("has no material for atom type 2 'steel'", [&] { planned(soft); });
}

/// A particle of the materials file stands for the material of its body; what a plan leaves out is noted.
TEST_F(DeckOptionsTest, ParticlesAndFlowLawsAreNoted)
{
  options_.materials_file = write(
      "m.toml", std::string(materials_text) +
                    "hardening = {law = \"swift\", strength = 251.1886e6, exponent = 0.2, offset = 0.01}\n"
                    "[particle.grain]\nradius = 2e-3\nmaterial = \"powder\"\n"
                    "layers = [{material = \"powder\", thickness = 2e-5}]\n");
  deck::Scene grain = powder_on_steel();
  grain.material_names = {"grain", "steel"};
  const PlannedDeck d = planned(grain);
  EXPECT_EQ(d.options.materials.at(1).yield_stress, 1e8);
  ASSERT_EQ(d.scene.notes.size(), 2u);
  EXPECT_NE(d.scene.notes[0].find("'grain' is planned as a homogeneous sphere"), std::string::npos);
  EXPECT_NE(d.scene.notes[1].find("'grain' is planned without its hardening 'swift'"), std::string::npos);
}

/// The step of thornton's deck is that of its own closed form, at the depth of its own collision.
TEST_F(DeckOptionsTest, TheModelOfTheDeckGivesItsStep)
{
  deck::Scene thornton = powder_on_steel();
  thornton.model = "thornton";
  thornton.law_file.clear();
  thornton.material_names.clear();
  thornton.materials[1].yield_stress = 1e8;
  thornton.materials[2].yield_stress = 1e12;
  options_.materials_file = "";
  const PlannedDeck d = planned(thornton);
  const deck::PairPlan& wall = d.plan.pairs.back();
  EXPECT_EQ(wall.overlap_basis, "Thornton");
  const double r = 2e-3, mass = 1500 * 4.0 / 3.0 * M_PI * r * r * r;
  const Thornton law(1e10, 1.6e8);
  // E* of 9.1e9 Pa and nu = 0.3 is 1e10 to the last digits; the stiffness grows with the depth
  EXPECT_NEAR(wall.time_step / largest_step(mass, law.stiffness(r, wall.overlap * r, 0.0)), 1, 1e-9);
}

TEST_F(DeckOptionsTest, StepsArePastedRoundedDown)
{
  EXPECT_EQ(step_text(5.2679e-6), "5.26e-06");
  EXPECT_EQ(step_text(5.26e-6), "5.26e-06");
}

TEST_F(DeckOptionsTest, WhatTheDeckDoesNotTellIsAskedFor)
{
  deck::Scene hidden = powder_on_steel();
  hidden.sources.clear();
  const PlannedDeck d = planned(hidden);
  EXPECT_FALSE(d.plan.complete());
  EXPECT_NE(questions_text(d.plan).find(": give it by --"), std::string::npos);
  expect_error("in.x: not in the deck: ", [&] { require_answers(d.plan, "in.x"); });
  deck::Plan complete;
  EXPECT_EQ(sentence_of([&] { require_answers(complete, "in.x"); }), "");
  complete.questions.push_back({"how many particles there are", "--particles N"});
  EXPECT_EQ(sentence_of([&] { require_answers(complete, "in.x"); }), "");  // of the cost only
}

TEST_F(DeckOptionsTest, RadiiMayStandInEitherOrder)
{
  options_.radius = {3e-3, 1e-3};
  const PlannedDeck d = planned();
  EXPECT_EQ(*d.options.radius_min, 1e-3);
  EXPECT_EQ(*d.options.radius_max, 3e-3);
}

TEST_F(DeckOptionsTest, TypesOfAPair)
{
  deck::Meeting meeting;
  meeting.a = 1;
  meeting.b = 2;
  EXPECT_EQ(types_text(meeting), "1:2");
  meeting.wall = true;
  EXPECT_EQ(types_text(meeting), "1:wall 2");
}

}  // namespace granulaw::deck_options_test
