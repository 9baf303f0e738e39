// Directions of impact, and the mass that takes part in it.
#include "characterise/shape/orientations.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "solver/shape/shapes.hpp"

namespace granulaw::orientations_test {

TEST(Orientations, LieInThePartThatTheMirrorPlanesLeave)
{
  const SharedShape shape = ellipsoid_shape({1, 2, 3});
  for (const Vector3& d : contact_directions(*shape)) {
    EXPECT_NEAR(d.norm(), 1, 1e-14);
    EXPECT_GE(d.minCoeff(), 0);
  }
  const SharedShape mirrored_in_x =
      clump_shape({{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}, {{0, 0.5, 0.3}, 1}}, "clump");
  const std::vector<Vector3> half = contact_directions(*mirrored_in_x, 200);
  bool beyond_y = false, beyond_z = false;
  for (const Vector3& d : half) {
    EXPECT_GE(d.x(), -1e-15);
    beyond_y |= d.y() < -0.5;
    beyond_z |= d.z() < -0.5;
  }
  EXPECT_TRUE(beyond_y && beyond_z);
}

TEST(Orientations, AreUniform)
{
  // The mean of z^2 over the sphere is 1/3; a lattice of 300 directions errs by about 1/300^(3/2) ... 1/300.
  const SharedShape uneven =
      clump_shape({{{-0.5, 0, 0}, 1}, {{0.5, 0.2, 0.1}, 0.9}, {{0, 0.5, 0.3}, 0.8}}, "clump");
  const std::vector<Vector3> directions = contact_directions(*uneven, 300);
  ASSERT_EQ(directions.size(), 300u);
  Vector3 mean = Vector3::Zero(), square = Vector3::Zero();
  for (const Vector3& d : directions) mean += d / 300, square += d.cwiseAbs2() / 300;
  EXPECT_NEAR(mean.norm(), 0, 1e-2);
  EXPECT_NEAR((square - Vector3::Constant(1.0 / 3)).norm(), 0, 1e-2);
}

TEST(Orientations, EffectiveMass)
{
  const SharedShape sphere = sphere_shape(2e-3);
  const Vector3 n = Vector3(1, 2, 3).normalized();
  EXPECT_NEAR(effective_mass_share(sphere->mass_properties(), 2e-3 * n, n), 1, 1e-14);
  // A thin rod of length l hit at its end, across: m_eff = m/4.
  const SharedShape rod = box_shape({1e-4, 1e-4, 1}, 1e-5);
  EXPECT_NEAR(effective_mass_share(rod->mass_properties(), {0, 0, 0.5}, Vector3::UnitX()), 0.25,
              1e-4);  // its width
}

TEST(Orientations, OfAnEllipsoid)
{
  const SharedShape ellipsoid = ellipsoid_shape({1, 2, 3});
  for (const Orientation& o : orientations_of(*ellipsoid, 20)) {
    EXPECT_NEAR(o.contact.dot(o.direction), ellipsoid->support(o.direction, nullptr), 1e-12);
    EXPECT_LE(o.radii.sharper, o.radii.flatter);
    EXPECT_TRUE(o.effective_mass > 0 && o.effective_mass <= 1);
  }
}

}  // namespace granulaw::orientations_test
