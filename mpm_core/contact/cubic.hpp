#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace granulaw {

/// A function at nodes: values, and slopes by the coordinate of the nodes. Cubic Hermite between them.
struct HermiteColumn
{
  std::vector<double> value, slope;

  std::size_t size() const { return value.size(); }
  void add(double v, double s) { value.push_back(v), slope.push_back(s); }
};

/// The column made to rise between nodes at `x`: values below an earlier one are raised to it, slopes limited
/// to 0 and three times the chord (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980: sufficient).
inline void make_rise(HermiteColumn& column, const std::vector<double>& x)
{
  auto& [value, slope] = column;
  for (std::size_t k = 1; k < value.size(); ++k) value[k] = std::max(value[k], value[k - 1]);
  for (std::size_t k = 0; k + 1 < value.size(); ++k) {
    const double most = 3.0 * (value[k + 1] - value[k]) / (x[k + 1] - x[k]);
    slope[k] = std::clamp(slope[k], 0.0, most);
    slope[k + 1] = std::clamp(slope[k + 1], 0.0, most);
  }
}
/// The column made never to rise: its mirror image made to rise.
inline void make_fall(HermiteColumn& column, const std::vector<double>& x)
{
  const auto mirror = [&] {
    for (double& v : column.value) v = -v;
    for (double& s : column.slope) s = -s;
  };
  mirror(), make_rise(column, x), mirror();
}

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

/// The least slope d/dt of a cubic over its interval.
inline double least_slope(const double (&c)[4])
{
  const double least = std::min(cubic_slope(c, 0.0), cubic_slope(c, 1.0));
  if (!(c[3] > 0)) return least;
  const double vertex = -c[2] / (3.0 * c[3]);
  return vertex > 0 && vertex < 1 ? std::min(least, cubic_slope(c, vertex)) : least;
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
  /// Straight on from t.
  CubicPair continued(double t) const { return {{both(t), slope_of_both(t), Two{}, Two{}}}; }
};

}  // namespace granulaw
