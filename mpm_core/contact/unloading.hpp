#pragma once

#include <algorithm>
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

/// Contact radius of a dent that unloads elastically. The pressure at full load is w times Hertz's half ellipse and
/// 1 - w times a uniform one. Each unloads by shrinking as a stack of flat punches, in the same radii, so that their
/// forces add (Mesarovic & Johnson, J. Mech. Phys. Solids 48, 2000, for the uniform one):
///     F/F_m = w c^3 + (1 - w) (2 t - sin 2 t)/pi,   c = a/a_m = sin t.
/// The overlap recovered is F_m/(2 E* a_m) times 3/2 of Hertz's and 4/pi of the uniform pressure: it says w.
struct DentUnloading
{
  double hertz = 1;  ///< w

  /// `recovered`: (delta_m - delta_r) 2 E* a_m/F_m. A stiffer dent than that of the uniform pressure counts as it.
  static DentUnloading of(double recovered)
  {
    constexpr double uniform = 4.0 / M_PI, all = 1.5;
    return {std::min(std::max((recovered - uniform) / (all - uniform), 0.0), 1.0)};
  }
  double force(double t) const
  {
    const double c = std::sin(t);
    return hertz * c * c * c + (1.0 - hertz) * (2.0 * t - std::sin(2.0 * t)) / M_PI;
  }
  /// dF/dt over sin^2 t.
  double slope(double t) const { return 3.0 * hertz * std::cos(t) + (1.0 - hertz) * 4.0 / M_PI; }
  /// t at F/F_m from 0 to 1, by Newton's method: asin(a/a_m).
  double angle(double force_share) const
  {
    if (!(force_share > 0.0)) return 0.0;
    if (force_share >= 1.0) return 0.5 * M_PI;
    // a small share: F = (w + (1 - w) 4/(3 pi)) t^3
    double t = std::min(std::cbrt(force_share / (hertz + (1.0 - hertz) * 4.0 / (3.0 * M_PI))), 0.5 * M_PI);
    for (int newton = 0; newton < 12; ++newton) {
      const double c = std::sin(t), change = (force(t) - force_share) / (c * c * slope(t));
      t = std::min(std::max(t - change, 0.1 * t), 0.5 * M_PI);
      if (std::abs(change) < 1e-12) break;
    }
    return t;
  }
};

}  // namespace granulaw
