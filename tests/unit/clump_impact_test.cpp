// A clump on a wall by the law of spheres: every ball that touches.
#include "characterise/shape/clump_impact.hpp"

#include <gtest/gtest.h>

#include "atlas/law_from_atlas.hpp"
#include "characterise/body/law_material.hpp"
#include "contact/body_behind.hpp"
#include "law/replay.hpp"
#include "own_atlas.hpp"

namespace granulaw::clump_impact_test {

BodyLaw law()
{
  Material m;
  m.density = 1000, m.youngs_modulus = 0.91e9, m.poisson_ratio = 0.3, m.yield_stress = 20e6;
  LawRange options;
  options.depth = 0.5;
  return law_from(tests::atlas(), law_material("powder", m), options);
}

constexpr double radius = 1e-3, mass = 1e-5, speed = 10;
const RigidBody body{mass, mass * radius * radius * Vector3(0.7, 1.0, 1.5).asDiagonal().toDenseMatrix()};

void expect_contact(const ContactAnswer& found, double force, double restitution)
{
  // of the steps: 5000 here, 20000 in the replay
  EXPECT_NEAR(found.force_max / force, 1, 1e-5);
  EXPECT_NEAR(found.restitution, restitution, 1e-5);
}

TEST(ClumpImpact, BallsAreThoseOfTheClump)
{
  const std::vector<ClumpBall> balls{{{0.1e-3, 0, 1.0 / 3}, radius}, {{0.2e-3, -1e-9, 1.0 / 3}, 0.97 * radius}};
  const std::vector<ClumpBall> found = balls_of(*clump_shape(balls, "test"));
  ASSERT_EQ(found.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(found[k].centre, balls[k].centre);
    EXPECT_EQ(found[k].radius, balls[k].radius);
  }
  EXPECT_TRUE(balls_of(*sphere_shape(radius)).empty());
}

TEST(ClumpImpact, OneBallIsTheReplayOfOneContact)
{
  for (const bool with_body : {false, true}) {
    const double centre = 0.4 * radius;  // below the centre of mass
    const double compliance = far_field(0.3) / law().material.e_star() * reach_behind(radius, centre + radius);
    const Replay one = replay_on_wall(law(), radius, mass, speed, with_body ? compliance : 0);
    const ClumpAnswer found = clump_on_wall(law(), {{{0, 0, centre}, radius}}, body, {0, 0, 1}, speed, with_body);
    expect_contact(found.contact, one.force_max, one.restitution);
    EXPECT_FALSE(found.left_range);
  }
}

/// Each of two like balls carries half of the mass, which is also the one that resists at one of them.
TEST(ClumpImpact, TwoBallsAtOnceAreTwoContacts)
{
  const Replay half = replay_on_wall(law(), radius, 0.5 * mass, speed);
  const ClumpAnswer found = clump_on_wall(law(), {{{radius, 0, 0}, radius}, {{-radius, 0, 0}, radius}}, body, {0, 0, 1}, speed, false);
  expect_contact(found.contact, 2 * half.force_max, half.restitution);
}

/// The mass that resists at the ball is less than the clump's; the turn during the contact is small but not nothing.
TEST(ClumpImpact, AnEccentricBallHasItsEffectiveMass)
{
  const Vector3 centre(0.3 * radius, 0, radius);
  const double share = 1 / (1 + 0.3 * 0.3 / 1.0);
  const Replay one = replay_on_wall(law(), radius, share * mass, speed);
  const ClumpAnswer found = clump_on_wall(law(), {{centre, radius}}, body, {0, 0, 1}, speed, false);
  EXPECT_NEAR(found.contact.force_max / one.force_max, 1, 0.01);  // 0.02 rad of turn times the lever of 0.3
  EXPECT_NEAR(found.contact.restitution, one.restitution, 0.01);
}

TEST(ClumpImpact, SaysWhereTheLawEnds)
{
  EXPECT_TRUE(clump_on_wall(law(), {{{0, 0, 0}, radius}}, body, {0, 0, 1}, 400, false).left_range);
}

}  // namespace granulaw::clump_impact_test
