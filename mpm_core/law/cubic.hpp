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

}  // namespace granulaw
