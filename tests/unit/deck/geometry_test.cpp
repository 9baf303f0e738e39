#include "base/larger.hpp"
#include "deck/geometry.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck {
namespace {

const Box wide{{-1, -2, -3}, {4, 6, 8}}, other{{0, -5, 2}, {10, 1, 3}};

TEST(Box, HoldsWhatItIncludes)
{
  Box b;
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(b.volume(), 0);
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
    EXPECT_EQ(turned.volume(), 0) << side;
  }
}

TEST(Box, WithinIsTheCommonPart)
{
  for (const Box& common : {wide.within(other), other.within(wide)}) {
    EXPECT_EQ(common.low, (Vec3{0, -2, 2}));
    EXPECT_EQ(common.high, (Vec3{4, 1, 3}));
    EXPECT_EQ(common.volume(), 12);
  }
  EXPECT_TRUE(wide.within(Box{{5, 0, 0}, {6, 1, 1}}).empty());
}

TEST(Box, TopAndBottomAreThoseOfItsCorners)
{
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0.6, 0, 0.8}, Vec3{-0.48, 0.6, -0.64}}) {
    double top = -Box::infinity, bottom = Box::infinity;
    for (const Vec3& p : wide.corners())
      top = larger(top, dot(p, axis)), bottom = std::min(bottom, dot(p, axis));
    EXPECT_NEAR(wide.top(axis), top, 1e-14);  // sums of three, rounded
    EXPECT_NEAR(wide.bottom(axis), bottom, 1e-14);
  }
  const Box layer{{-Box::infinity, -Box::infinity, 1}, {Box::infinity, Box::infinity, 2}};
  EXPECT_EQ(layer.top({0, 0, 1}), 2);
  EXPECT_EQ(layer.bottom({0, 0, 1}), 1);
  Box of_corners;
  for (const Vec3& p : wide.corners()) of_corners.include(p);
  EXPECT_EQ(of_corners.low, wide.low);
  EXPECT_EQ(of_corners.high, wide.high);
}

TEST(Rotated, KeepsLengthAndAxisAndGoesAroundOnce)
{
  const Vec3 p{0.3, -1.2, 0.7}, axis{1, 2, -2};
  for (const double degrees : {30.0, 90.0, 200.0}) {
    const Vec3 q = rotated(p, axis, degrees), back = rotated(q, axis, -degrees);
    EXPECT_NEAR(norm(q), norm(p), 1e-14);
    EXPECT_NEAR(dot(q, axis), dot(p, axis), 1e-14);
    EXPECT_NEAR(norm(back - p), 0, 1e-14);
    // the angle, between what stands on the axis
    const Vec3 foot = dot(p, axis) / dot(axis, axis) * axis, a = p - foot, b = q - foot;
    EXPECT_NEAR(dot(a, b) / dot(a, a), std::cos(degrees * M_PI / 180), 1e-14);
    const Vec3 cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    EXPECT_NEAR(dot(cross, axis) / norm(axis) / dot(a, a), std::sin(degrees * M_PI / 180), 1e-14);
  }
  EXPECT_EQ(rotated(p, {0, 0, 0}, 30), p);  // no axis
}

TEST(Geometry, VolumeOfABall)
{
  EXPECT_DOUBLE_EQ(ball_volume(0.5), M_PI / 6);
}

TEST(Geometry, RotatesAsTheRightHandDoes)
{
  const Vec3 p = rotated({1, 0, 0}, {0, 0, 2}, 90);
  EXPECT_NEAR(p[0], 0, 1e-15);  // rounding of cos 90 degrees
  EXPECT_NEAR(p[1], 1, 1e-15);
}

}  // namespace
}  // namespace granulaw::deck
