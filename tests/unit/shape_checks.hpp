#pragma once
// Conditions that every shape must fulfil, and points to evaluate it at.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "solver/shape/shape.hpp"

namespace granulaw {

inline std::vector<Vector3> random_points(const Shape& shape, int count, double stretch = 1.3)
{
  Vector3 low, high;
  shape.bounds(low, high);
  const Vector3 middle = 0.5 * (low + high), half = 0.5 * stretch * (high - low);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<Vector3> points;
  for (int k = 0; k < count; ++k)
    points.push_back(middle + half.cwiseProduct(Vector3(share(random), share(random), share(random))));
  return points;
}

inline std::vector<Vector3> random_directions(int count)
{
  std::mt19937 random(11);
  std::normal_distribution<double> component;
  std::vector<Vector3> directions;
  for (int k = 0; k < count; ++k)
    directions.push_back(Vector3(component(random), component(random), component(random)).normalized());
  return directions;
}

inline double size_of(const Shape& shape)
{
  Vector3 low, high;
  shape.bounds(low, high);
  return (high - low).maxCoeff();
}

/// No two depths differ by more than the distance of their points, apart from `rounding` of the body's size.
inline void expect_lipschitz(const Shape& shape, double rounding = 1e-12)
{
  const double allowed = rounding * size_of(shape);
  const std::vector<Vector3> points = random_points(shape, 400);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; j += 7)
      ASSERT_LE(std::abs(shape.depth(points[i]) - shape.depth(points[j])),
                (points[i] - points[j]).norm() + allowed);
}

/// A support point lies on the surface, has the direction as its normal, and no surface point lies farther
/// on.
inline void expect_support(const Shape& shape, double tolerance = 1e-9)
{
  const double size = size_of(shape);
  for (const Vector3& n : random_directions(60)) {
    Vector3 where;
    const double reach = shape.support(n, &where);
    EXPECT_NEAR(reach, n.dot(where), tolerance * size);
    EXPECT_NEAR(shape.depth(where), 0, tolerance * size);
    EXPECT_LE(shape.depth(where + 1e-3 * size * n), -1e-3 * size * (1 - 1e-6));
    for (const Vector3& x : random_points(shape, 20, 1))
      EXPECT_TRUE(shape.depth(x) < 0 || n.dot(x) <= reach + tolerance * size);
  }
}

/// Depth falls at unit rate along the outward normal, near the surface.
inline void expect_normals(const Shape& shape, double tolerance = 1e-6)
{
  const double size = size_of(shape), step = 1e-4 * size;
  for (const Vector3& n : random_directions(60)) {
    Vector3 where;
    shape.support(n, &where);
    const Vector3 outside = where + 0.05 * size * n;
    EXPECT_NEAR((shape.outward_normal(outside) - n).norm(), 0, tolerance);
    EXPECT_NEAR(shape.depth(outside) - shape.depth(outside + step * n), step, tolerance * step);
  }
}

/// The body's gap to its support plane is quadratic with the two radii: compared at a small distance.
inline void expect_radii(const Shape& shape, double tolerance = 1e-3)
{
  for (const Vector3& n : random_directions(40)) {
    Vector3 where;
    shape.support(n, &where);
    const PrincipalRadii radii = shape.principal_radii(n);
    const Vector3 other = n.cross(radii.sharper_direction);
    EXPECT_NEAR(radii.sharper_direction.dot(n), 0, 1e-6);
    const double small = 1e-3 * radii.sharper;
    for (const auto& [radius, along] :
         {std::pair{radii.sharper, radii.sharper_direction}, {radii.flatter, other}}) {
      // Outside along the tangent the distance to the surface is s^2/(2 R), to order s^4 and s^3; the mean of
      // both sides has no s^3.
      const double gap = -0.5 * (shape.depth(where + small * along) + shape.depth(where - small * along));
      EXPECT_NEAR(gap * 2 * radius / (small * small), 1, tolerance);
    }
  }
}

}  // namespace granulaw
