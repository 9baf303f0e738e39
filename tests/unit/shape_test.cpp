// Three-dimensional bodies against closed forms and against each other.
#include "solver/shape/shape.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "refusal.hpp"
#include "shape_checks.hpp"
#include "solver/shape/particle.hpp"
#include "solver/shape/rotation.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::shape_test {

using std::numbers::pi;

const std::vector<ClumpBall> three_balls{{{0, 0, 0}, 1}, {{1, 0.3, 0}, 0.8}, {{0.2, 0.9, 0.4}, 0.7}};

/// Where a face is flat the point of contact moves far for a small change of the normal, and the radii change within the gap that
/// is measured. 0: not examined, as an edge or a groove has no normal, chords no radii.
TEST(Shapes, FulfilWhatEveryShapeMust)
{
  const struct
  {
    SharedShape shape;
    double normals, radii;
  } all[] = {{sphere_shape(2e-3), 1e-6, 1e-3},
             {ellipsoid_shape({1e-3, 2e-3, 3e-3}), 1e-6, 1e-3},
             {superquadric_shape({1e-3, 2e-3, 1.5e-3}, 4, 4), 1e-5, 0.02},
             {superquadric_shape({1e-3, 2e-3, 1.5e-3}, 3, 5), 1e-5, 0.02},
             {superquadric_shape({1e-3, 2e-3, 1.5e-3}, 2.5, 2), 1e-5, 0.02},
             {box_shape({1e-3, 2e-3, 3e-3}, 0.2e-3), 1e-6, 1e-3},
             {clump_shape(three_balls, "clump"), 0, 1e-3},
             {revolved_shape(conical_tip(1e-3, 40, 0.2e-3)), 0, 0}};
  for (const auto& [shape, normals, radii] : all) {
    SCOPED_TRACE(shape->kind());
    expect_lipschitz(*shape);
    expect_support(*shape);
    if (normals > 0) expect_normals(*shape, normals);
    if (radii > 0) expect_radii(*shape, radii);
  }
  EXPECT_DOUBLE_EQ(sphere_shape(2e-3)->mass_properties().volume, 4.0 / 3.0 * pi * 8e-9);
}

TEST(Ellipsoid, WithEqualAxesIsTheSphere)
{
  const SharedShape ellipsoid = ellipsoid_shape({2e-3, 2e-3, 2e-3});
  const SharedShape sphere = sphere_shape(2e-3);
  for (const Vector3& x : random_points(*sphere, 200)) {
    EXPECT_NEAR(ellipsoid->depth(x), sphere->depth(x), 1e-15);  // rounding
    EXPECT_NEAR((ellipsoid->outward_normal(x) - sphere->outward_normal(x)).norm(), 0, 1e-12);
  }
}

TEST(Ellipsoid, DepthOnItsSymmetryPlanesAndInItsCentre)
{
  const SharedShape ellipsoid = ellipsoid_shape({1, 2, 3});
  EXPECT_NEAR(ellipsoid->depth({0, 0, 0}), 1, 1e-14);
  EXPECT_NEAR(ellipsoid->depth({0, 0, 2.9}), 0.1, 1e-14);  // within the radius of curvature 1/3 of the end
  // Nearest to (0, 0, z) is x^2 + (Z - z)^2 with x^2 = 1 - Z^2/9, so Z = 9 z/8.
  EXPECT_NEAR(ellipsoid->depth({0, 0, 1}), std::sqrt(1 - 9.0 / 64 + 1.0 / 64), 1e-14);
  EXPECT_NEAR(ellipsoid->depth({1e-18, 0, 1}), std::sqrt(1 - 9.0 / 64 + 1.0 / 64), 1e-14);
  EXPECT_NEAR(ellipsoid->depth({0, 5, 0}), -3, 1e-14);
}

TEST(Ellipsoid, RadiiAtTheEndOfAnAxis)
{
  const SharedShape ellipsoid = ellipsoid_shape({1, 2, 3});
  const PrincipalRadii radii = ellipsoid->principal_radii(Vector3::UnitZ());
  EXPECT_NEAR(radii.sharper, 1.0 / 3, 1e-14);  // a^2/c
  EXPECT_NEAR(radii.flatter, 4.0 / 3, 1e-14);  // b^2/c
  EXPECT_NEAR(std::abs(radii.sharper_direction.x()), 1, 1e-14);
  EXPECT_NEAR(ellipsoid->finest_radius(), 1.0 / 3, 1e-14);
}

TEST(Ellipsoid, InertiaInClosedForm)
{
  const MassProperties mass = ellipsoid_shape({1, 2, 3})->mass_properties();
  EXPECT_NEAR(mass.volume, 8 * pi, 1e-13);
  EXPECT_NEAR(mass.inertia(0, 0), mass.volume * 13 / 5, 1e-12);  // m (b^2 + c^2)/5
  EXPECT_NEAR(mass.inertia(2, 2), mass.volume * 5 / 5, 1e-12);
}

TEST(Superquadric, WithExponentsTwoIsTheEllipsoid)
{
  const SharedShape ellipsoid = ellipsoid_shape({1e-3, 2e-3, 3e-3});
  const SharedShape superquadric = superquadric_shape({1e-3, 2e-3, 3e-3}, 2, 2);
  // Newton's method ends at 1e-8 of the distance, along the surface.
  for (const Vector3& x : random_points(*ellipsoid, 300)) {
    EXPECT_NEAR(superquadric->depth(x), ellipsoid->depth(x), 1e-12);
    EXPECT_NEAR((superquadric->outward_normal(x) - ellipsoid->outward_normal(x)).norm(), 0, 1e-5);
  }
  for (const Vector3& n : random_directions(30)) {
    Vector3 a, b;
    EXPECT_NEAR(superquadric->support(n, &a), ellipsoid->support(n, &b), 1e-17);
    EXPECT_NEAR((a - b).norm(), 0, 1e-17);
    EXPECT_NEAR(superquadric->principal_radii(n).sharper / ellipsoid->principal_radii(n).sharper, 1, 1e-12);
    EXPECT_NEAR(superquadric->principal_radii(n).flatter / ellipsoid->principal_radii(n).flatter, 1, 1e-12);
  }
  const MassProperties own = superquadric->mass_properties(), other = ellipsoid->mass_properties();
  EXPECT_NEAR(own.volume / other.volume, 1, 1e-12);
  EXPECT_NEAR((own.inertia - other.inertia).norm() / other.inertia.norm(), 0, 1e-12);
  EXPECT_NEAR(superquadric->finest_radius() / ellipsoid->finest_radius(), 1, 1e-3);  // the search's last step
}

/// Volume, centre and inertia by points of a fine raster.
MassProperties by_raster(const Shape& shape, int n)
{
  Vector3 low, high;
  shape.bounds(low, high);
  const Vector3 step = (high - low) / n;
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vector3 x = low + step.cwiseProduct(Vector3(i + 0.5, j + 0.5, k + 0.5));
        if (shape.depth(x) < 0) continue;
        volume += step.prod();
        first += step.prod() * x;
        second += step.prod() * x * x.transpose();
      }
  first /= volume;
  second -= volume * first * first.transpose();
  return {volume, first, second.trace() * Eigen::Matrix3d::Identity() - second};
}

void expect_equal_mass(const MassProperties& own, const MassProperties& other, double size, double tolerance)
{
  EXPECT_NEAR(own.volume / other.volume, 1, tolerance);
  EXPECT_NEAR((own.centre - other.centre).norm(), 0, tolerance * size);
  EXPECT_NEAR((own.inertia - other.inertia).norm() / other.inertia.norm(), 0, 2 * tolerance);
}

TEST(Shapes, MassIsThatOfARaster)
{
  const SharedShape superquadric = superquadric_shape({1, 2, 1.5}, 3, 5);
  const SharedShape box = box_shape({1, 2, 3}, 0.3);
  const SharedShape clump = clump_shape(three_balls, "clump");
  const SharedShape drop = revolved_shape(conical_tip(1, 40, 0.2));
  // 60^3 points: the surface's cells are wrong by chance, 1e-3 of the volume.
  for (const SharedShape& shape : {superquadric, box, clump, drop})
    expect_equal_mass(shape->mass_properties(), by_raster(*shape, 60), size_of(*shape), 2e-3);
}

TEST(Box, InClosedForm)
{
  const SharedShape box = box_shape({2, 4, 6}, 0.5);
  EXPECT_DOUBLE_EQ(box->depth({0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(box->depth({1, 0, 0}), 0);
  EXPECT_NEAR(box->depth({0.5 + 0.3, 1.5 + 0.4, 0}), 0, 1e-15);  // 3-4-5 triangle on the edge's rounding
  EXPECT_DOUBLE_EQ(box->depth({0, 0, 5}), -2);
  const PrincipalRadii edge = box->principal_radii(Vector3(1, 1, 0).normalized());
  EXPECT_EQ(edge.sharper, 0.5);
  EXPECT_TRUE(std::isinf(edge.flatter));
  EXPECT_NEAR(edge.sharper_direction.z(), 0, 1e-15);
  EXPECT_TRUE(std::isinf(box->principal_radii(Vector3::UnitX()).sharper));
  // With edges as round as they can be, a cube is the sphere.
  const MassProperties round = box_shape({2, 2, 2}, 1)->mass_properties(),
                       sphere = sphere_shape(1)->mass_properties();
  expect_equal_mass(round, sphere, 1, 1e-14);
  const MassProperties sharp = box_shape({2, 4, 6}, 0)->mass_properties();
  EXPECT_NEAR(sharp.volume, 48, 1e-13);
  EXPECT_NEAR(sharp.inertia(0, 0), 48 * (16 + 36) / 12.0, 1e-12);
}

TEST(Clump, OfOneSphereIsTheSphere)
{
  const SharedShape sphere = sphere_shape(2e-3);
  // The second one is inside the first and disappears.
  const SharedShape clump = clump_shape({{{0, 0, 0}, 2e-3}, {{1e-3, 0, 0}, 0.5e-3}}, "clump");
  for (const Vector3& x : random_points(*sphere, 200)) {
    EXPECT_NEAR(clump->depth(x), sphere->depth(x), 1e-17);
    EXPECT_NEAR((clump->outward_normal(x) - sphere->outward_normal(x)).norm(), 0, 1e-12);
  }
  EXPECT_EQ(clump->finest_radius(), 2e-3);
  EXPECT_EQ(clump->symmetric(), (std::array<bool, 3>{true, true, true}));
  // 500 x 500 columns
  expect_equal_mass(clump->mass_properties(), sphere->mass_properties(), 2e-3, 2e-5);
}

TEST(Clump, DepthIsTheDistanceToTheNearestOfManySurfacePoints)
{
  const SharedShape clump = clump_shape(three_balls, "clump");
  std::vector<Vector3> surface;
  for (const ClumpBall& ball : three_balls)
    for (const Vector3& n : random_directions(20000)) {
      const Vector3 point = ball.centre + ball.radius * n;
      if (std::all_of(three_balls.begin(), three_balls.end(), [&](const ClumpBall& other) {
            return (point - other.centre).norm() >= other.radius * (1 - 1e-12);
          }))
        surface.push_back(point);
    }
  for (const Vector3& x : random_points(*clump, 300, 1)) {
    double least = 10;
    for (const Vector3& point : surface) least = std::min(least, (point - x).norm());
    EXPECT_LE(std::abs(clump->depth(x)), least + 1e-12);
    // About 20 000 points on an area of 4 pi leave holes of 0.05.
    EXPECT_GE(std::abs(clump->depth(x)), least - 0.05);
  }
}

TEST(Clump, TwoBallsInClosedForm)
{
  const SharedShape clump = clump_shape({{{-1, 0, 0}, std::sqrt(2.0)}, {{1, 0, 0}, std::sqrt(2.0)}}, "clump");
  // The groove is the circle of radius 1 about the x axis: nearest to the middle.
  EXPECT_NEAR(clump->depth({0, 0, 0}), 1, 1e-14);
  EXPECT_NEAR(clump->depth({0, 0.6, 0}), 0.4, 1e-14);
  EXPECT_NEAR(clump->depth({1 + std::sqrt(2.0) - 0.1, 0, 0}), 0.1, 1e-14);
  // A ball less the cap of height r - 1: V = pi h^2 (3 r - h)/3.
  const double r = std::sqrt(2.0), h = r - 1;
  EXPECT_NEAR(clump->mass_properties().volume / (2 * (4 * pi / 3 * r * r * r - pi * h * h * (3 * r - h) / 3)),
              1, 2e-5);
}

TEST(Clump, NeedsSpheres)
{
  EXPECT_EQ(sentence_of([] { clump_shape({}, "a"); }), "a: the clump has no spheres");
}

TEST(Revolved, HasItsProfilesSymmetryAndRadius)
{
  const SharedShape drop = revolved_shape(conical_tip(1e-3, 40, 0.2e-3));
  EXPECT_EQ(drop->symmetric(), (std::array<bool, 3>{true, true, false}));
  EXPECT_NEAR(drop->finest_radius() / 0.2e-3, 1, 1e-3);  // chords
}

TEST(Revolved, EllipsoidIsTheEllipsoid)
{
  const SharedShape revolved = revolved_shape(ellipsoid(1e-3, 1.5));
  const SharedShape other = ellipsoid_shape({1e-3, 1e-3, 1.5e-3});
  EXPECT_EQ(revolved->symmetric(), other->symmetric());
  for (const Vector3& x : random_points(*other, 200)) {
    EXPECT_NEAR(revolved->depth(x), other->depth(x), 1.01e-9);  // chord error 1e-6
    EXPECT_NEAR((revolved->outward_normal(x) - other->outward_normal(x)).norm(), 0,
                3e-3);  // chords: 2 sqrt(2e-6)
  }
  // Chord error of 1e-6: 4e-6 of the volume, see particle_test.cpp
  expect_equal_mass(revolved->mass_properties(), other->mass_properties(), 1e-3, 4e-6);
  for (const Vector3& n : random_directions(20)) {
    // The profile's vertices have normals 3e-3 apart, over which the radii change by up to three times that.
    EXPECT_NEAR(revolved->principal_radii(n).sharper / other->principal_radii(n).sharper, 1, 1e-2);
    EXPECT_NEAR(revolved->principal_radii(n).flatter / other->principal_radii(n).flatter, 1, 1e-2);
  }
}

TEST(Rotation, TurnBringsATangentToX)
{
  for (const Vector3& direction : {Vector3(0, 0, -1), Vector3(0.3, -0.5, 0.8), Vector3(-1, 0.1, 0)}) {
    const Vector3 d = direction.normalized(), tangent = d.cross(Vector3(0.2, 0.7, 0.4)).normalized();
    const Eigen::Matrix3d rotation = rotation_to_plane(d, turn_along(d, tangent));
    EXPECT_LT((rotation * d + Vector3::UnitZ()).norm(), 1e-14);
    EXPECT_LT((rotation * tangent - Vector3::UnitX()).norm(), 1e-14);
  }
}

TEST(Particle, LayersAndInclusionsLieWhereTheParticleHasThem)
{
  Particle p;
  p.radius = 1;
  p.materials.resize(3);
  p.layers = {{0.1, 1}};
  p.inclusions = {{0, 0.3, 0.1, 2}, {0.5, 1, 0.1, -1}};
  const auto sphere = shape_of(p);
  for (const Vector3& x : random_points(*sphere, 500))
    EXPECT_EQ(p.material_at(x, sphere->depth(x)), p.material_at(std::hypot(x.x(), x.y()), x.z() + 1));

  p.shape = box_shape(Vector3(2, 2, 2), 0.1);
  p.inclusions = {{0, 0.3, 0.1, -1, 0.5, -0.2}};
  const auto material = [&](const Vector3& x) { return p.material_at(x, p.shape->depth(x)); };
  EXPECT_EQ(material({0.95, 0, 0}), 1);
  EXPECT_EQ(material({0.5, -0.2, 0.3}), -1);
  EXPECT_EQ(material({0.5, 0.2, 0.3}), 0);
  EXPECT_EQ(material({1.1, 0, 0}), -1);
  validate(p, "p");
  p.layers = {{1.1, 1}};
  EXPECT_EQ(sentence_of([&] { validate(p, "p"); }),
            "p: the layers leave no core: they are thicker than the body is deep: found 1.1 m, "
            "allowed is below 1 m");
  p.layers.clear();
  p.inclusions = {{0, 0.3, 0.8, -1, 0.5, -0.2}};
  EXPECT_EQ(sentence_of([&] { validate(p, "p"); }),
            "p: inclusion 1 reaches the surface: its radius: found 0.8 m, allowed is below 0.5 m at (0.5, "
            "-0.2, 0.3) m");
  EXPECT_EQ(sentence_of([&] { check_revolution(p, "p"); }),
            "p: has a shape in three dimensions, which cannot be taken here yet: found kind = \"box\", "
            "allowed is a sphere "
            "or a profile");
}

}  // namespace granulaw::shape_test
