// Hertz's contact over an ellipse: tabulated values and limits.
#include "elliptic_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace granulaw::elliptic_contact_test {

using std::numbers::pi;

TEST(EllipticContact, EqualRadiiAreHertzsCircle)
{
  const double R = 2e-3, E = 10e9, delta = 1e-6;
  const EllipticContact contact({R, R}, E);
  const double force = contact.force(delta);
  EXPECT_NEAR(force / (4.0 / 3.0 * E * std::sqrt(R) * std::pow(delta, 1.5)), 1, 1e-14);
  EXPECT_NEAR(contact.semi_major(force) / std::sqrt(R * delta), 1, 1e-12);
  EXPECT_NEAR(contact.peak_pressure(force) / (2 * E / pi * std::sqrt(delta / R)), 1, 1e-12);
  EXPECT_NEAR(contact.equivalent_radius() / R, 1, 1e-14);
  // Continuous there: the terms of first order in the difference vanish.
  EXPECT_NEAR(EllipticContact({R * 1.001, R / 1.001}, E).force(delta) / force, 1, 1e-6);
}

/// Timoshenko and Goodier, Theory of Elasticity, section 140: a = m h, b = n h with h = (3 P/(4 E* (A +
/// B)))^(1/3), over theta, cos(theta) = (B - A)/(A + B). Printed to three digits.
TEST(EllipticContact, TabulatedAxes)
{
  const double table[][3] = {{30, 2.731, 0.493}, {45, 1.926, 0.604}, {60, 1.486, 0.717}, {75, 1.202, 0.846}};
  for (const auto& [theta, m, n] : table) {
    const double cosine = std::cos(theta * pi / 180), a = (1 - cosine) / 2,
                 b = (1 + cosine) / 2;                                // A + B = 1
    const EllipticContact contact({1 / (2 * a), 1 / (2 * b)}, 0.75);  // h = 1 at P = 1
    EXPECT_NEAR(contact.semi_major(1), m, 2e-3);
    EXPECT_NEAR(contact.semi_minor(1), n, 2e-3);
  }
}

TEST(EllipticContact, OverlapIsTheIntegralOfPressure)
{
  // delta = 3 P K(e)/(2 pi a E*) (Johnson eq. 4.27 with 4.22), of the axes alone; force and overlap are
  // inverse.
  for (const double ratio : {1.5, 4.0, 100.0}) {
    const EllipticContact contact({ratio, 1}, 2);
    const double force = 0.3, q = contact.axis_ratio();
    const double k = std::comp_ellint_1(std::sqrt(1 - q * q));
    EXPECT_NEAR(contact.overlap(force) / (1.5 * force * k / (pi * contact.semi_major(force) * 2)), 1, 1e-12);
    EXPECT_NEAR(contact.force(contact.overlap(force)) / force, 1, 1e-12);
  }
}

TEST(EllipticContact, SlenderContactsHaveTheLinesWidth)
{
  // As R'/R'' grows, b goes to that of a line contact of the same peak pressure: p0 = E* b/(2 R'')
  // (Johnson 4.45).
  const EllipticContact contact({1e6, 1}, 1);
  EXPECT_NEAR(contact.peak_pressure(1) / (contact.semi_minor(1) / 2), 1, 1e-3);
}

TEST(EllipticContact, RelativeRadii)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const ContactRadii on_wall = relative_radii({3, 2}, {infinity, infinity}, 0.3);
  EXPECT_NEAR(on_wall.flatter, 3, 1e-14);
  EXPECT_NEAR(on_wall.sharper, 2, 1e-14);
  // Crossed equal cylinders touch as a sphere of their radius on a wall.
  const ContactRadii crossed = relative_radii({infinity, 2}, {infinity, 2}, pi / 2);
  EXPECT_NEAR(crossed.flatter, 2, 1e-14);
  EXPECT_NEAR(crossed.sharper, 2, 1e-14);
}

}  // namespace granulaw::elliptic_contact_test
