// Error of the law of spheres for a body of any shape.
#include "characterise/shape/shape_certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "atlas/law_from_atlas.hpp"
#include "characterise/body/law_material.hpp"
#include "own_atlas.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::shape_certificate_test {

/// E*/Y = 50: cheap runs.
Material powder()
{
  Material m;
  m.density = 1000, m.youngs_modulus = 0.91e9, m.poisson_ratio = 0.3, m.yield_stress = 20e6;
  return m;
}

BodyLaw law()
{
  LawRange options;
  options.depth = 0.5;
  return law_from(tests::atlas(), law_material("powder", powder()), options);
}

Particle of_shape(SharedShape solid)
{
  Particle particle;
  particle.materials = {powder()};
  particle.radius = std::cbrt(solid->mass_properties().volume / (4.0 / 3.0 * M_PI));
  particle.shape = std::move(solid);
  return particle;
}

ShapeQuestion question(double velocity)
{
  ShapeQuestion q;
  q.directions = 4;
  q.velocities = {velocity};
  q.resolution = 6;
  return q;
}

/// The law is a sphere's own, in every direction.
TEST(ShapeCertificate, OfASphereIsTheSolversError)
{
  ThreadFarm farm(2);
  const ShapeCertificate certificate = certify_shape(of_shape(sphere_shape(1e-3)), law(), question(20), farm);
  EXPECT_EQ(certificate.covered(), 1);
  for (const OrientationCheck& check : certificate.checks) {
    EXPECT_NEAR(check.effective_mass, 1, 1e-9);
    EXPECT_NEAR(check.local_radius(), 1e-3, 1e-9);
  }
  // a single grid of 6 cells: 2 % of F and 1 % of e (docs/evidence/solver-accuracy.md)
  EXPECT_LT(certificate.force().largest, 0.03);
  EXPECT_LT(certificate.restitution().largest, 0.02);
  EXPECT_GT(certificate.solver_error, 0);
}

/// A corner of radius r is flattened over more than r: no sphere of that radius gives what follows.
TEST(ShapeCertificateSlow, SaysWhereACornerIsFlattened)
{
  const Vector3 sides(2e-3, 2e-3, 2e-3);
  ThreadFarm farm(2);
  const ShapeQuestion q = question(30);
  const ShapeCertificate certificate = certify_shape(of_shape(box_shape(sides, 0.3e-3)), law(), q, farm);
  EXPECT_LT(certificate.covered(), 1);
  for (const OrientationCheck& check : certificate.checks) {
    EXPECT_LT(check.effective_mass, 1);  // no direction of the lattice passes through the centre
    EXPECT_GT(check.solver.force_max, 0);
    EXPECT_GT(check.solver.restitution, 0);
    EXPECT_LT(check.solver.restitution, 1);  // though the contact moves far over the body
  }
}

TEST(ShapeCertificate, WantsABodyOfOneMaterial)
{
  Particle two = of_shape(sphere_shape(1e-3));
  two.materials.push_back(powder());
  ThreadFarm farm(1);
  EXPECT_THROW(certify_shape(two, law(), question(1), farm), Error);
}

}  // namespace granulaw::shape_certificate_test
