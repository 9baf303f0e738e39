// Three-dimensional bodies against closed forms and against each other.
#include "solver/solid/solid.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "solid_checks.hpp"
#include "solver/solid/ellipsoid_solid.hpp"
#include "solver/solid/sphere_solid.hpp"

namespace granulaw {
namespace {

using std::numbers::pi;

TEST(Sphere, FulfilsWhatEverySolidMust)
{
  const SphereSolid sphere(2e-3);
  expect_lipschitz(sphere);
  expect_support(sphere);
  expect_normals(sphere);
  expect_radii(sphere);
  EXPECT_DOUBLE_EQ(sphere.mass_properties().volume, 4.0 / 3.0 * pi * 8e-9);
}

TEST(Ellipsoid, FulfilsWhatEverySolidMust)
{
  const EllipsoidSolid ellipsoid({1e-3, 2e-3, 3e-3});
  expect_lipschitz(ellipsoid);
  expect_support(ellipsoid);
  expect_normals(ellipsoid);
  expect_radii(ellipsoid);
}

TEST(Ellipsoid, WithEqualAxesIsTheSphere)
{
  const EllipsoidSolid ellipsoid({2e-3, 2e-3, 2e-3});
  const SphereSolid sphere(2e-3);
  for (const Vector3& x : random_points(sphere, 200)) {
    EXPECT_NEAR(ellipsoid.depth(x), sphere.depth(x), 1e-15);  // rounding
    EXPECT_NEAR((ellipsoid.outward_normal(x) - sphere.outward_normal(x)).norm(), 0, 1e-12);
  }
}

TEST(Ellipsoid, DepthOnItsSymmetryPlanesAndInItsCentre)
{
  const EllipsoidSolid ellipsoid({1, 2, 3});
  EXPECT_NEAR(ellipsoid.depth({0, 0, 0}), 1, 1e-14);
  EXPECT_NEAR(ellipsoid.depth({0, 0, 2.9}), 0.1, 1e-14);  // within the radius of curvature 1/3 of the end
  // Nearest to (0, 0, z) is x^2 + (Z - z)^2 with x^2 = 1 - Z^2/9, so Z = 9 z/8.
  EXPECT_NEAR(ellipsoid.depth({0, 0, 1}), std::sqrt(1 - 9.0 / 64 + 1.0 / 64), 1e-14);
  EXPECT_NEAR(ellipsoid.depth({1e-18, 0, 1}), std::sqrt(1 - 9.0 / 64 + 1.0 / 64), 1e-14);
  EXPECT_NEAR(ellipsoid.depth({0, 5, 0}), -3, 1e-14);
}

TEST(Ellipsoid, RadiiAtTheEndOfAnAxis)
{
  const EllipsoidSolid ellipsoid({1, 2, 3});
  const PrincipalRadii radii = ellipsoid.principal_radii(Vector3::UnitZ());
  EXPECT_NEAR(radii.sharper, 1.0 / 3, 1e-14);  // a^2/c
  EXPECT_NEAR(radii.flatter, 4.0 / 3, 1e-14);  // b^2/c
  EXPECT_NEAR(std::abs(radii.sharper_direction.x()), 1, 1e-14);
  EXPECT_NEAR(ellipsoid.finest_radius(), 1.0 / 3, 1e-14);
}

TEST(Ellipsoid, InertiaInClosedForm)
{
  const MassProperties mass = EllipsoidSolid({1, 2, 3}).mass_properties();
  EXPECT_NEAR(mass.volume, 8 * pi, 1e-13);
  EXPECT_NEAR(mass.inertia(0, 0), mass.volume * 13 / 5, 1e-12);  // m (b^2 + c^2)/5
  EXPECT_NEAR(mass.inertia(2, 2), mass.volume * 5 / 5, 1e-12);
}

}  // namespace
}  // namespace granulaw
