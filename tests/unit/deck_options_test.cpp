#include "deck_options.hpp"

#include <cmath>

#include "law/contact_step.hpp"

#include "scratch_folder.hpp"

namespace granulaw {
namespace {

constexpr const char* deck_text =
    "atom_style granular\n"
    "boundary f f f\n"
    "units si\n"
    "region box block -0.05 0.05 -0.05 0.05 0 0.5 units box\n"
    "create_box 2 box\n"
    "fix m1 all property/global youngsModulus peratomtype 9.1e9 2e11\n"
    "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\n"
    "pair_style gran model mpm tangential history law law.h5 materials powder steel\n"
    "pair_coeff * *\n"
    "timestep 1e-6\n"
    "fix g all gravity 9.81 vector 0 0 -1\n"
    "fix floor all wall/gran model mpm tangential history primitive type 2 zplane 0.0\n"
    "fix t1 all particletemplate/sphere 15485863 atom_type 1 density constant 1500 radius constant ${r}\n"
    "fix d1 all particledistribution/discrete 32452843 1 t1 1.0\n"
    "fix i1 all insert/pack seed 32452867 distributiontemplate d1 vel constant 0 0 -2 insert_every once "
    "overlapcheck yes particles_in_region 100 region box\n"
    "run 1000\n";

constexpr const char* materials_text =
    "[material.powder]\ndensity = 1500\nyoungs_modulus = 9.1e9\npoisson_ratio = 0.3\nyield_stress = 1e8\n";

class DeckOptionsTest : public ScratchFolder
{
 protected:
  void SetUp() override
  {
    ScratchFolder::SetUp();
    options_.materials_file = write("m.toml", materials_text);
    options_.variables = {"r", "2e-3"};
  }
  PlannedDeck planned(const std::string& text = deck_text) const
  {
    return plan_deck(write("in.deck", text), options_);
  }
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
  const auto with_names = [](const std::string& names) {
    std::string text = deck_text;
    return text.replace(text.find("powder steel"), 12, names);
  };
  expect_error("'materials' of pair_style: " + options_.materials_file +
                   " has no material for atom type 1 'powdr' (did you mean 'powder'?): allowed is powder",
               [&] { planned(with_names("powdr steel")); });
  // the plug-in's own word for a type without yield
  const PlannedDeck elastic = planned(with_names("elastic steel"));
  EXPECT_FALSE(elastic.options.materials.at(1).yields());
  EXPECT_EQ(elastic.plan.pairs.back().overlap_basis, "Hertz");
  // a wall that gives way has a material, too
  std::string soft = deck_text;
  soft.replace(soft.find("primitive type 2"), 16, "wall deformable primitive type 2");
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
  std::string text = deck_text;
  const PlannedDeck d = planned(text.replace(text.find("powder steel"), 12, "grain steel"));
  EXPECT_EQ(d.options.materials.at(1).yield_stress, 1e8);
  ASSERT_EQ(d.scene.notes.size(), 2u);
  EXPECT_NE(d.scene.notes[0].find("'grain' is planned as a homogeneous sphere"), std::string::npos);
  EXPECT_NE(d.scene.notes[1].find("'grain' is planned without its hardening 'swift'"), std::string::npos);
}

/// The step of thornton's deck is that of its own closed form, at the depth of its own collision.
TEST_F(DeckOptionsTest, TheModelOfTheDeckGivesItsStep)
{
  std::string text = deck_text;
  text.replace(text.find("model mpm tangential history law law.h5 materials powder steel"), 62,
               "model thornton tangential history");
  text.insert(text.find("pair_style"), "fix y all property/global yieldStress peratomtype 1e8 1e12\n");
  options_.materials_file = "";
  const PlannedDeck d = planned(text);
  const deck::PairPlan& wall = d.plan.pairs.back();
  EXPECT_EQ(wall.overlap_basis, "Thornton");
  const double r = 2e-3, mass = 1500 * 4.0 / 3.0 * M_PI * r * r * r;
  const ThorntonPair law{1e10, 1.6e8};
  // E* of 9.1e9 Pa and nu = 0.3 is 1e10 to the last digits; the stiffness grows with the depth
  EXPECT_NEAR(wall.time_step / largest_step(mass, planned_stiffness(law, r, wall.overlap * r)), 1, 1e-9);
}

TEST_F(DeckOptionsTest, StepsArePastedRoundedDown)
{
  EXPECT_EQ(step_text(5.2679e-6), "5.26e-06");
  EXPECT_EQ(step_text(5.26e-6), "5.26e-06");
}

TEST_F(DeckOptionsTest, WhatTheDeckDoesNotTellIsAskedFor)
{
  options_.variables = {};  // no radius
  const PlannedDeck d = planned();
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
  options_.variables = {};
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

}  // namespace
}  // namespace granulaw
