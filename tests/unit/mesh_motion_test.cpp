#include "liggghts_plugin/plan/mesh_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace granulaw::plugin::plan::mesh_motion_test {

using Point = Box::Point;
using Triangles = std::vector<MeshMotion::Triangle>;

/// Two triangles of a sheet.
Triangles sheet(const Point& a, const Point& b, const Point& c, const Point& d)
{
  return {{a, b, c}, {a, c, d}};
}

/// 24 facets around the z axis.
Triangles drum()
{
  Triangles all;
  const auto at = [](int k, double z) { return Point{std::cos(2 * M_PI * k / 24), std::sin(2 * M_PI * k / 24), z}; };
  for (int k = 0; k < 24; ++k)
    for (const auto& t : sheet(at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1))) all.push_back(t);
  return all;
}

template <class Velocity>
MeshMotion seen(const Triangles& mesh, Velocity&& velocity, const Point& upward = {0, 0, 1})
{
  Triangles velocities = mesh;
  for (auto& t : velocities)
    for (Point& p : t) p = velocity(p);
  MeshMotion motion;
  motion.look(mesh, velocities, upward);
  return motion;
}

const Triangles plate = sheet({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});

TEST(MeshMotion, APlatePushesAcrossItselfAndByItsEdges)
{
  for (const Point& v : {Point{0, 0, 2}, Point{2, 0, 0}, Point{0, -2, 0}})
    EXPECT_NEAR(seen(plate, [&](const Point&) { return v; }).push_speed(), 2, 1e-12);
  // a corner ahead
  EXPECT_NEAR(seen(plate, [](const Point&) { return Point{1, 1, 0}; }).push_speed(), std::sqrt(2), 1e-12);
  EXPECT_NEAR(seen(plate, [](const Point&) { return Point{0, 0, 2}; }).level_push_speed(), 0, 1e-12);
  EXPECT_NEAR(seen(plate, [](const Point&) { return Point{0, 0, 2}; }, {1, 0, 0}).level_push_speed(), 2, 1e-12);
}

TEST(MeshMotion, ADrumDragsAndItsLifterPushes)
{
  const auto turns = [](const Point& p) { return Point{-p[1], p[0], 0}; };
  EXPECT_NEAR(seen(drum(), turns).speed(), 1, 1e-12);
  EXPECT_LT(seen(drum(), turns).push_speed(), 0.14);  // sin(pi/24): a facet is no circle
  Triangles with_lifter = drum();
  for (const auto& t : sheet({1, 0, 0}, {0.8, 0, 0}, {0.8, 0, 1}, {1, 0, 1})) with_lifter.push_back(t);
  EXPECT_NEAR(seen(with_lifter, turns).push_speed(), 1, 1e-12);
  // along its axis: by its rim
  EXPECT_NEAR(seen(drum(), [](const Point&) { return Point{0, 0, 1}; }).push_speed(), 1, 1e-12);
}

TEST(MeshMotion, TheLiftIsThatOfAPoint)
{
  MeshMotion motion;
  Triangles at = plate, velocities(plate.size());
  for (const double z : {0.0, -0.3, 0.1}) {
    for (auto& t : at)
      for (Point& p : t) p[2] = z;
    motion.look(at, velocities, {0, 0, 1});
  }
  EXPECT_NEAR(motion.lift(), 0.4, 1e-15);
}

}  // namespace granulaw::plugin::plan::mesh_motion_test
