#include "yielding_contact.hpp"

#include <gtest/gtest.h>

#include "characterise/run/request.hpp"
#include "atlas/law_from_atlas.hpp"
#include "oblique_replay.hpp"
#include "own_atlas.hpp"

namespace granulaw::yielding_contact_test {

/// A sphere of E*/Y = 100, radius 1 mm.
struct Sphere
{
  LawMaterial material{"m", 1500, 9.1e9, 0.3, 1e8, 0};
  BodyLaw law;
  double mass = 1500 * 4.0 / 3 * M_PI * 1e-9;

  explicit Sphere(double hardening_over_modulus = 0)
  {
    material.hardening_modulus = hardening_over_modulus * material.youngs_modulus;
    BuildOptions options;
    options.depth = 0.3, options.fastest = 0.25;
    law = law_from(tests::own_atlas(), material, options);
  }
  /// At V over Thornton's yield velocity, 0.13 m/s here.
  ObliqueThrow thrown(double velocity, double angle) const
  {
    const double v = velocity * std::pow(M_PI / 2e10, 2) * std::sqrt(2 / (5 * 1500.0)) * std::pow(1.6e8, 2.5);
    return {1e-3, mass, v, v * std::tan(angle * M_PI / 180)};
  }
  TangentialSpring spring(double friction) const { return {friction, 4 * 9.1e9 / (1.3 * 1.7), 0, true}; }
  FlowStress flow() const { return {1e8, material.hardening_modulus}; }
};

TEST(YieldingContact, HeadOnItIsTheLaw)
{
  const Sphere sphere;
  const ObliqueThrow thrown = sphere.thrown(100, 0);
  const double law = replay_spring(sphere.law, thrown, sphere.spring(0.6)).restitution;
  const ObliqueAnswer told = replay_yielding(sphere.law, thrown, sphere.spring(0.6), sphere.flow());
  EXPECT_NEAR(told.restitution, law, 1e-12);  // the same forces, up to rounding
  EXPECT_EQ(told.spin, 0);
}

TEST(YieldingContact, WithoutAYieldLimitItIsTheSpring)
{
  const Sphere sphere;
  for (const double angle : {10.0, 45.0, 70.0}) {
    const ObliqueThrow thrown = sphere.thrown(100, angle);
    const ObliqueAnswer spring = replay_spring(sphere.law, thrown, sphere.spring(0.3));
    const ObliqueAnswer told = replay_yielding(sphere.law, thrown, sphere.spring(0.3), {1e30, 0});
    // q = T/T_0 is 1e-20: what is left is the order of the roundings
    EXPECT_NEAR(told.restitution, spring.restitution, 1e-6);
    EXPECT_NEAR(told.tangential, spring.tangential, 1e-6 * thrown.tangential_velocity);
    EXPECT_NEAR(told.spin, spring.spin, 1e-6 * thrown.tangential_velocity / thrown.radius);
  }
}

TEST(YieldingContact, TheForcesStayWithinFrictionAndTheYieldCurve)
{
  const Sphere sphere;
  const PairLaw pair = wall_pair(sphere.law);
  const double r = 1e-3, stiffness = sphere.spring(0).stiffness;
  // shear flows on until the contact is as deep as an overlap a few per cent larger: a tenth is enough
  const double widest = pair.evaluate(r, 1.1 * 0.03 * r, 0).contact_radius;
  // no hardening: T_0 is the same at every strain
  const double strength = YieldingContact::widening * 1e8 / std::sqrt(3.0) * M_PI * widest * widest;
  YieldingContact contact(pair, r, 0, stiffness, 0.6, sphere.flow());
  double work = 0;
  const auto go = [&](double from, double to, double slide) {
    const int steps = 2000;
    for (int k = 1; k <= steps; ++k) {
      const ContactForces f = contact.move(from + (to - from) * k / steps, slide / steps, 0);
      EXPECT_LE(std::abs(f.tangential), 0.6 * f.normal * (1 + 1e-12));  // rounding
      EXPECT_LE(std::abs(f.tangential), strength);
      work += f.normal * (to - from) / steps + f.tangential * slide / steps;
    }
  };
  go(0, 0.02 * r, 0.01 * r);
  go(0.02 * r, 0.018 * r, -0.02 * r);
  go(0.018 * r, 0.03 * r, 0.03 * r);
  go(0.03 * r, 1e-6 * r, 0.02 * r);
  EXPECT_GT(work, 0);  // a closed path takes work, it gives none
}

/// Results of the solver in three dimensions (docs/evidence/oblique.md).
struct Known
{
  double hardening, velocity, friction, angle, e, tangential, spin;
};

TEST(YieldingContact, ItHoldsWhatTheSolverTells)
{
  // 100 V_y: 10 cells; 20 V_y: 8 cells
  const Known known[] = {{0, 100, 0.3, 10, 0.514, 0.616, 0.163},
                         {0, 100, 0.6, 50, 0.456, 0.648, 1.021},
                         {0, 20, 0.6, 30, 0.729, 0.656, 0.498},
                         {0.05, 100, 0.6, 10, 0.561, 0.643, 0.155},
                         {0.05, 100, 0.3, 60, 0.547, 0.732, 1.115}};
  for (const Known& k : known) {
    const Sphere sphere(k.hardening);
    const ObliqueThrow thrown = sphere.thrown(k.velocity, k.angle);
    const ObliqueAnswer told = replay_yielding(sphere.law, thrown, sphere.spring(k.friction), sphere.flow());
    // what the page states of these materials at angles up to 60 degrees
    EXPECT_NEAR(told.restitution, k.e, 0.05 * k.e);
    EXPECT_NEAR(told.tangential / thrown.tangential_velocity, k.tangential, 0.02);
    EXPECT_NEAR(told.spin * 1e-3 / thrown.velocity, k.spin, 0.05 * k.spin);
  }
}

}  // namespace granulaw::yielding_contact_test
