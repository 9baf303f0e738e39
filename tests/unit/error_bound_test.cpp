#include "law/pair_statement.hpp"

#include <gtest/gtest.h>

#include "law/damage_number.hpp"
#include "synthetic_law.hpp"

namespace granulaw::error_bound_test {

/// Fresh impacts include every error of an atlas law but that of their cells.
TEST(ErrorBound, OfTheAtlasIsThatOfItsChecksAndOfTheirCells)
{
  Certificate c;
  c.origin = "atlas";
  c.atlas_error_force = 0.003, c.atlas_error_restitution = 0.015;  // of e: absolute
  c.solver_error_force = 0.004, c.solver_error_restitution = 0.04;
  c.interpolation_error = c.held_out_error = 0.1;  // in what the checks found
  const ErrorBound bound = bound_of(c);
  EXPECT_DOUBLE_EQ(bound.force, 0.005);
  EXPECT_DOUBLE_EQ(bound.restitution_at(0.5), 0.025);
}

TEST(ErrorBound, OfRunsIsWhatImpactsFoundAndWhatTheCellsCost)
{
  Certificate c;
  c.verification_impacts = 3;
  c.verification_error_force = 0.003, c.verification_error_restitution = 0.006;
  c.solver_error_force = 0.004, c.solver_error_restitution = 0.008;
  c.atlas_error_force = 0.1;    // of the law without speed: in what the impacts found
  c.interpolation_error = 0.1;  // the same
  const ErrorBound bound = bound_of(c);
  EXPECT_DOUBLE_EQ(bound.force, 0.005);
  EXPECT_DOUBLE_EQ(bound.restitution_at(0.5), 0.005);
}

TEST(ErrorBound, WithoutImpactsIsWhatFitAndTableLeave)
{
  Certificate c;
  c.damage_number_max = std::numeric_limits<double>::infinity();  // elastic
  c.origin = "atlas";
  c.atlas_error_force = 0.008;
  c.interpolation_error = 0.006;
  EXPECT_DOUBLE_EQ(bound_of(c).force, 0.01);
  EXPECT_DOUBLE_EQ(bound_of(c).with({0.024, 0, 0.1}).force, 0.026);
  EXPECT_DOUBLE_EQ(bound_of(c).with({0.024, 0, 0.1}).restitution_at(1), 0.1);
}

TEST(ErrorBound, NamesWhetherItIsOfItself)
{
  EXPECT_EQ((ErrorBound{0.0072, 0.0028}.text()), "F_max 0.72 %, e 0.0028");
  EXPECT_EQ((ErrorBound{0.0123, 0, 0.1}.text()), "F_max 1.2 %, e 10 %");
  EXPECT_EQ((ErrorBound{0.0123, 0.003, 0.1}.text()), "F_max 1.2 %, e 0.003 and 10 %");
  EXPECT_EQ(ErrorBound{}.text(), "not stated");
}

/// A known difference adds in full; between two speeds it is linear, beyond the last it stays.
TEST(ErrorBound, GrowsByWhatAnOmittedAxisCosts)
{
  ErrorBound bound{0.01, 0.003, 0.004};
  bound.omitted_axis = {{0.1, -0.02, 0.01}, {0.2, 0.04, 0.03}};
  EXPECT_DOUBLE_EQ(bound.at(0).force, 0.01);
  EXPECT_DOUBLE_EQ(bound.at(0.05).force, 0.01 + 0.01 * 1.01);
  EXPECT_DOUBLE_EQ(bound.at(0.15).force, 0.01 + 0.01 * 1.01);
  EXPECT_DOUBLE_EQ(bound.at(1).force, 0.04 + 0.01 * 1.04);
  EXPECT_DOUBLE_EQ(bound.at(0.2).restitution_at(0.5), 0.015 + std::hypot(0.003, 0.002));
  EXPECT_EQ(bound.text(), "F_max 1 %, e 0.003 and 0.4 %, rising with speed to F_max 5 %, e 0.003 and 3.4 %");
  const ErrorBound worst = bound.worst({0.02, 0, 0, {{0.05, 0.5, 0}}});
  EXPECT_DOUBLE_EQ(worst.at(0.05).force, 0.5 + 0.02 * 1.5);
  EXPECT_DOUBLE_EQ(worst.at(0.2).restitution_at(1), 0.03 + std::hypot(0.003, 0.004));
  EXPECT_FALSE(bound.worst({}).stated());
}

/// A law of like sizes, and one for a deformable wall: what `mpm table` makes where no --radius-ratio is
/// given.
class PairStatements : public ::testing::Test
{
 protected:
  PairStatements() : law_(tests::SyntheticLaw{}.law())
  {
    TwoBodyLaw wall;
    wall.law = law_.bodies.at("powder");
    wall.law.certificate.origin = composed_origin;
    wall.law.certificate.atlas_error_force = 0.015, wall.law.certificate.atlas_error_restitution = 0.012;
    wall.law.certificate.damage_number_max = 0.001;
    wall.law.state();
    wall.radius_ratio = std::numeric_limits<double>::infinity();
    law_.pair_laws["powder:powder"] = {wall};
    BodyLaw& powder = law_.bodies.at("powder");
    powder.certificate.origin = "atlas";
    powder.certificate.atlas_error_force = 0.0072, powder.certificate.atlas_error_restitution = 0.0028;
    powder.state();
  }
  PairStatement at(double radius_a, double radius_b) const
  {
    const PairLaw pair = resolve_pair(law_, "powder", "powder", "here", radius_a, radius_b);
    return statement_of(law_, pair, "powder", "powder")
        .at_distance(distance_in_size(law_, pair, "powder", "powder", radius_a, radius_b));
  }
  Law law_;
};

TEST_F(PairStatements, LikeSizesHaveTheBodysOwn)
{
  const PairStatement s = at(1, 1);
  EXPECT_EQ(s.kind, LawKind::single);
  EXPECT_TRUE(s.covers_size());
  EXPECT_EQ(s.bound.force, 0.0072);
  EXPECT_EQ(s.damage_number_max, 0.002);
}

TEST_F(PairStatements, AThickWallHasThatOfTheComposedLaw)
{
  const PairStatement s = at(std::numeric_limits<double>::infinity(), 1);
  EXPECT_EQ(s.kind, LawKind::composed);
  EXPECT_TRUE(s.covers_size());
  EXPECT_EQ(s.bound.force, 0.015);
  EXPECT_EQ(s.damage_number_max, 0.001);
}

/// 0.6 mm on 3 mm of wax at 3 m/s: e of the law was 0.0133 off the solver's under a stated 0.012.
TEST_F(PairStatements, SizesBetweenTwoLawsHaveALargerBound)
{
  const PairStatement s = at(3e-3, 0.6e-3);
  EXPECT_EQ(s.kind, LawKind::composed);
  EXPECT_FALSE(s.covers_size());
  EXPECT_NEAR(s.size_off, 1 / 6.0, 1e-12);
  EXPECT_GT(s.bound.restitution_at(0.57), 0.0133);
  const PairStatement nearer = at(1, 2);  // nearest: like sizes
  EXPECT_EQ(nearer.kind, LawKind::reduced);
  EXPECT_NEAR(nearer.size_off, 0.5 - 1 / 3.0, 1e-12);
}

/// By the pair rule: like bodies of near sizes keep their own bound, no error is stated of unlike ones.
TEST_F(PairStatements, OfUnlikeBodiesByThePairRuleNoErrorIsStated)
{
  law_.pair_laws.clear();
  EXPECT_EQ(at(1, 1).bound.force, 0.0072);
  const PairStatement mixed = statement_of(law_, resolve_pair(law_, "powder", "glass", "here"), "powder", "glass");
  EXPECT_EQ(mixed.kind, LawKind::reduced);
  EXPECT_EQ(mixed.bound.text(), "not stated");
  EXPECT_EQ(mixed.at_distance(0.2).bound.text(), "not stated");
}

/// Measured: up to 17 % of e at radii 1 : 10 (docs/evidence/pairs.md).
TEST_F(PairStatements, OfATwoBodyLawAtOtherSizesNoErrorIsStated)
{
  TwoBodyLaw& own = law_.pair_laws["powder:powder"].front();
  own.law.certificate.origin = "runs", own.radius_ratio = 2;
  own.law.bound.size_force = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(at(1, 2).bound.stated());
  EXPECT_FALSE(at(1, 3).bound.stated());
}

/// One definition: density and yield stress of the yielding body, its fraction of the approach.
TEST_F(PairStatements, TheDamageNumberIsThatOfTheYieldingBodysShare)
{
  const LawMaterial& m = law_.bodies.at("powder").material;
  const double on_wall = m.density * 9.0 / m.yield_stress;
  const PairLaw wall = resolve_pair(law_, "powder", "wall", "here");
  EXPECT_DOUBLE_EQ(damage_number(wall, 3), on_wall);
  for (const double ratio : {1.0, 5.0}) {
    const PairLaw like = resolve_pair(law_, "powder", "powder", "here", 1, ratio);
    EXPECT_DOUBLE_EQ(damage_number(like, 6), on_wall) << ratio;
  }
}

}  // namespace granulaw::error_bound_test
