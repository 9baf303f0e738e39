#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace granulaw {

/// Unloading and reloading of a yielded contact: F = F_m phi(u), u = (delta - delta_r)/(delta_m - delta_r)
/// from 0 where the force ends to 1 at the reversal,
///     phi = A u^1.5 + B u^2 + C u^2.5,   A + B + C = 1.
///
/// Reasons for this form: it is Hertz's u^1.5 with the finite sphere's next two terms. The elastic sphere's
/// curve is one of them, F_Hertz (1 + c1 sqrt(x) + c2 x), so unloading passes through the onset of yield
/// without a jump in work or stiffness. Over the reference presses (E*/Y 20 to 500, to 0.2 R) it lies within
/// 0.1 to 0.4 % of F_m, u^n within 0.2 to 1.5 %. It needs one square root, no power.
/// Two numbers say which:
///     exponent n = d ln F/d ln u at the reversal = phi'(1)        B = 5 - 2 A - 2 n,  C = A + 2 n - 4
///     Hertz coefficient     A = F/(F_m u^1.5) as u -> 0
/// phi rises from 0 to 1, so that no force is negative, where A >= 0, A + 4 n <= 10 and n >= 0 (phi' is
/// sqrt(u)/2 times a quadratic in sqrt(u) whose Bernstein coefficients are 3 A, 10 - A - 4 n and 2 n).
struct UnloadingShape
{
  double exponent = 1.5, hertz_share = 1.0;

  static constexpr double least_exponent = 1.0, largest_hertz_share = 6.0;
  static double largest_exponent(double hertz_share) { return 0.25 * (10.0 - hertz_share); }
  bool rises() const
  {
    return hertz_share >= 0 && exponent >= 0 && exponent <= largest_exponent(hertz_share);
  }

  double second() const { return 5.0 - 2.0 * (hertz_share + exponent); }
  double third() const { return hertz_share + 2.0 * exponent - 4.0; }

  struct Point
  {
    double value, slope;  ///< phi, phi'
  };
  /// At 0 <= u <= 1.
  Point at(double u) const
  {
    const double root = std::sqrt(u), b = second(), c = third();
    return {u * root * ((hertz_share + root * b) + u * c),
            root * ((1.5 * hertz_share + root * (2.0 * b)) + u * (2.5 * c))};
  }
  /// Integral of phi from 0 to u.
  double work(double u) const
  {
    const double w = std::sqrt(u);
    return 2.0 * u * u * w * (hertz_share / 5.0 + w * (second() / 6.0 + w * (third() / 7.0)));
  }
  /// work(1) = (11 - 2 n)/21 + 2 A/105: what the unloading gives back, over F_m (delta_m - delta_r).
  double work() const { return (11.0 - 2.0 * exponent) / 21.0 + hertz_share * (2.0 / 105.0); }
  /// The n with which work() is `work`.
  static double exponent_of(double work, double hertz_share) { return 5.5 - 10.5 * work + 0.2 * hertz_share; }
  /// The A with which it is that at this exponent.
  static double hertz_share_of(double work, double exponent)
  {
    return 5.0 * (exponent - exponent_of(work, 0.0));
  }
  /// The A beyond which exponent_of(work, A) is over largest_exponent(A).
  static double largest_hertz_share_of(double work) { return (2.5 - exponent_of(work, 0.0)) / 0.45; }
};

/// Contact radius of a dent while it unloads and reloads: a = a_m sqrt(u) k, u as of UnloadingShape. k is the cubic by
/// sqrt(u) through three numbers of the dent and 1 at full load. They are measured (docs/theory/law.md): 1 is a dent
/// under Hertz's pressure; one under a uniform pressure, whose rim stays in contact for longer, has 1.41, 1.37, 1.25.
struct UnloadingRadius
{
  std::array<double, 3> k{1.0, 1.0, 1.0};  ///< at sqrt(u) = 0, 1/3, 2/3

  static constexpr double least = -2.0, most = 10.0;  ///< of k, whose end at 0 is extrapolated
  /// a/a_m at sqrt(u) = `root`.
  double share(double root) const
  {
    const double t = 3.0 * root, first = k[1] - k[0], second = k[2] - 2.0 * k[1] + k[0],
                 third = 1.0 - 3.0 * (k[2] - k[1]) - k[0];
    const double now = k[0] + t * (first + (t - 1.0) * (0.5 * second + (t - 2.0) * (1.0 / 6.0 * third)));
    return std::min(std::max(root * now, 0.0), 1.0);
  }
};

}  // namespace granulaw
