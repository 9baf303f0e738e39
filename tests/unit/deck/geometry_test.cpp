#include "base/larger.hpp"
#include "liggghts_plugin/plan/geometry.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck::geometry_test {

const Box wide{{-1, -2, -3}, {4, 6, 8}}, other{{0, -5, 2}, {10, 1, 3}};

TEST(Box, HoldsWhatItIncludes)
{
  Box b;
  EXPECT_TRUE(b.empty());
  b.include(Vec3{1, 2, 3});
  EXPECT_FALSE(b.empty());
  b.include(Vec3{-1, 5, 3});
  EXPECT_EQ(b.low, (Vec3{-1, 2, 3}));
  EXPECT_EQ(b.high, (Vec3{1, 5, 3}));
  b.include(Box{});  // nothing
  EXPECT_EQ(b.size(), (Vec3{2, 3, 0}));
  Box all = wide;
  all.include(other);
  EXPECT_EQ(all.low, (Vec3{-1, -5, -3}));
  EXPECT_EQ(all.high, (Vec3{10, 6, 8}));
  for (std::size_t side = 0; side < 3; ++side) {
    Box turned = wide;
    std::swap(turned.low[side], turned.high[side]);
    EXPECT_TRUE(turned.empty()) << side;
  }
}

TEST(Box, WithinIsTheCommonPart)
{
  for (const Box& common : {wide.within(other), other.within(wide)}) {
    EXPECT_EQ(common.low, (Vec3{0, -2, 2}));
    EXPECT_EQ(common.high, (Vec3{4, 1, 3}));
  }
  EXPECT_TRUE(wide.within(Box{{5, 0, 0}, {6, 1, 1}}).empty());
}

TEST(Box, TopAndBottomAreThoseOfItsCorners)
{
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0.6, 0, 0.8}, Vec3{-0.48, 0.6, -0.64}}) {
    double top = -Box::infinity, bottom = Box::infinity;
    for (const double x : {wide.low[0], wide.high[0]})
      for (const double y : {wide.low[1], wide.high[1]})
        for (const double z : {wide.low[2], wide.high[2]}) {
          const double along = dot(Vec3{x, y, z}, axis);
          top = larger(top, along), bottom = std::min(bottom, along);
        }
    EXPECT_NEAR(wide.top(axis), top, 1e-14);  // sums of three, rounded
    EXPECT_NEAR(wide.bottom(axis), bottom, 1e-14);
  }
  const Box layer{{-Box::infinity, -Box::infinity, 1}, {Box::infinity, Box::infinity, 2}};
  EXPECT_EQ(layer.top({0, 0, 1}), 2);
  EXPECT_EQ(layer.bottom({0, 0, 1}), 1);
}

TEST(Geometry, VolumeOfABall)
{
  EXPECT_DOUBLE_EQ(ball_volume(0.5), M_PI / 6);
}

}  // namespace granulaw::deck::geometry_test
