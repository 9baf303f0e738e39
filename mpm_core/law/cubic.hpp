#pragma once

namespace granulaw {

/// A cubic c[0] + c[1] t + c[2] t^2 + c[3] t^3 over one interval, 0 <= t <= 1, and its derivative by t.
inline double cubic(const double (&c)[4], double t)
{
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}
inline double cubic_slope(const double (&c)[4], double t)
{
  return c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]);
}

/// Cubic Hermite coefficients from end values and end slopes d/dt.
inline void hermite(double (&c)[4], double v0, double v1, double m0, double m1)
{
  c[0] = v0;
  c[1] = m0;
  c[2] = 3.0 * (v1 - v0) - 2.0 * m0 - m1;
  c[3] = 2.0 * (v0 - v1) + m0 + m1;
}

/// Two numbers that one instruction works on.
using Two [[gnu::vector_size(16)]] = double;

/// Two cubics side by side, for the price of one. One cache line.
struct alignas(64) CubicPair
{
  Two c[4];

  void set(int which, const double (&coefficients)[4])
  {
    for (int power = 0; power < 4; ++power) c[power][which] = coefficients[power];
  }
  Two both(double t) const { return (c[0] + t * c[1]) + t * t * (c[2] + t * c[3]); }
  /// The first alone, to the bit.
  double first(double t) const { return (c[0][0] + t * c[1][0]) + t * t * (c[2][0] + t * c[3][0]); }
  double first_slope(double t) const { return c[1][0] + t * (2.0 * c[2][0] + t * (3.0 * c[3][0])); }
  Two slope_of_both(double t) const { return c[1] + t * (2.0 * c[2] + t * (3.0 * c[3])); }
};

}  // namespace granulaw
