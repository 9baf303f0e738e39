#include "claim.hpp"

#include <gtest/gtest.h>

namespace granulaw {
namespace {

/// Fresh impacts tell everything that an atlas law leaves: nothing is added to what its checks bound.
TEST(Claim, OfTheAtlasIsTheBoundOfItsChecks)
{
  Certificate c;
  c.origin = "atlas";
  c.atlas_error_force = 0.002, c.atlas_error_restitution = 0.02;  // of e: absolute
  c.solver_error_force = c.solver_error_restitution = 0.04;
  const Claim claim = claim_of(c, 0.5);
  EXPECT_DOUBLE_EQ(claim.force, 0.002);
  EXPECT_DOUBLE_EQ(claim.restitution, 0.04);
}

TEST(Claim, OfRunsIsWhatImpactsFoundAndWhatTheCellsCost)
{
  Certificate c;
  c.verification_impacts = 3;
  c.verification_error_force = 0.003, c.verification_error_restitution = 0.006;
  c.solver_error_force = 0.004, c.solver_error_restitution = 0.008;
  c.atlas_error_force = 0.1;    // of the law at no rate: in what the impacts found
  c.interpolation_error = 0.1;  // the same
  const Claim claim = claim_of(c, 0.5);
  EXPECT_DOUBLE_EQ(claim.force, 0.005);
  EXPECT_DOUBLE_EQ(claim.restitution, 0.01);
}

TEST(Claim, WithoutImpactsIsWhatFitAndTableLeave)
{
  Certificate c;
  c.damage_number_max = std::numeric_limits<double>::infinity();  // elastic
  c.origin = "atlas";
  c.atlas_error_force = 0.008;
  c.interpolation_error = 0.006;
  EXPECT_DOUBLE_EQ(claim_of(c, 1.0).force, 0.01);
  EXPECT_DOUBLE_EQ(claim_of(c, 1.0).with(0.024, 0.1).force, 0.026);
  EXPECT_DOUBLE_EQ(claim_of(c, 1.0).with(0.024, 0.1).restitution, 0.1);
}

TEST(Claim, IsToldInPerCent)
{
  EXPECT_EQ(percent(0.01234), "1.2 %");
  EXPECT_EQ(errors_text(0.0123, 0.1), "force within 1.2 %, e within 10 %");
  Certificate c;
  c.atlas_error_force = 0.0072;
  c.atlas_error_restitution = 0.0028;
  EXPECT_EQ(atlas_errors_text(c), "force within 0.72 %, e within 0.0028");
}

}  // namespace
}  // namespace granulaw
