#include "claim.hpp"

#include <gtest/gtest.h>

namespace granulaw {
namespace {

TEST(Claim, AddsWhatTheCertificateStates)
{
  Certificate c;
  c.verification_error_force = 0.001;
  c.atlas_error_force = 0.002;
  c.solver_error_force = 0.004;
  c.verification_error_restitution = 0.01;
  c.atlas_error_restitution = 0.02;  // absolute
  c.solver_error_restitution = 0.04;
  const Claim claim = claim_of(c, 0.5);
  EXPECT_DOUBLE_EQ(claim.force, 0.007);
  EXPECT_DOUBLE_EQ(claim.restitution, 0.09);
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
