#include "deck/meeting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck::meeting_test {

TEST(DeckMeeting, DeformableWallsAreBodiesOfTheirMaterial)
{
  PlanOptions options;
  options.materials[1] = {"steel", 7800, 2e11, 0.3, 1e9, 0};
  options.materials[2] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  Scene deforming = falling();
  deforming.walls[0].deformable = true;
  const Plan plan = make_plan(deforming, options), rigid = make_plan(falling(), options);
  const Meeting& wall = plan.pairs[1].meeting;
  EXPECT_TRUE(wall.wall && wall.deformable);
  EXPECT_EQ(wall.name_b, "wax");
  EXPECT_EQ(wall.yields.name, "wax");  // the weaker: the wall
  EXPECT_EQ(rigid.pairs[1].meeting.name_b, "wall");
  EXPECT_EQ(rigid.pairs[1].meeting.yields.name, "steel");
  EXPECT_LT(plan.pairs[1].onset, rigid.pairs[1].onset);
  // as Hertz has it, 1/E* = 1/E*_s + 1/E*_h
  EXPECT_NEAR(wall.mapping.e_star_pair() * (1 / wall.yields.e_star() + 0.91 / 2e11), 1, 1e-12);
  EXPECT_TRUE(pair_sizes(plan).thick_walls);
  EXPECT_FALSE(pair_sizes(rigid).thick_walls);
}

/// The rule of the law library, ties by name and all: the plan requires the table that the plug-in will look
/// up.
TEST(Meeting, YieldsAsTheLawHasIt)
{
  std::mt19937 dice(1);
  const auto one_of = [&](std::vector<double> values) { return values[dice() % values.size()]; };
  for (int k = 0; k < 200; ++k) {
    AtomType a, b;
    a.type = 1;
    b.type = 2;
    for (AtomType* t : {&a, &b}) {
      t->material.name = std::array{"alum", "steel", "zinc"}[dice() % 3];
      t->material.density = 1000;
      t->material.youngs_modulus = one_of({1e9, 2e9});
      t->material.poisson_ratio = one_of({0.2, 0.3});
      t->material.yield_stress = one_of({1e6, 2e6});
      t->material.hardening_modulus = one_of({0, 1e7});
    }
    const bool first = yields_first(a.material, b.material);
    const LawMaterial &yielding = first ? a.material : b.material, &partner = first ? b.material : a.material;
    const Meeting m = meeting_of(a, b);
    EXPECT_EQ(m.yields.name, yielding.name);
    EXPECT_EQ(m.yields.hardening_modulus, yielding.hardening_modulus);
    EXPECT_EQ(m.mapping.e_star, yielding.e_star());
    EXPECT_EQ(m.mapping.sqrt_lambda, 1 + yielding.e_star() / partner.e_star());
  }
}

TEST(Meeting, OfTwoEquallyStrongAndStiffTheFirstByNameYields)
{
  AtomType a, b;
  a.material = {"zinc", 7000, 1e9, 0.3, 1e6, 0};
  b.material = {"alum", 2700, 1e9, 0.3, 1e6, 1e7};
  EXPECT_EQ(meeting_of(a, b).yields.name, "alum");
  EXPECT_EQ(meeting_of(b, a).yields.name, "alum");
}

}  // namespace granulaw::deck::meeting_test
