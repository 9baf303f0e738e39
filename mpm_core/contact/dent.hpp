#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

// Geometry of a dent that turns against what it is pressed on, and the yield curve of a contact under shear.
// docs/theory/oblique.md has the equations by their numbers.
namespace granulaw {

/// The part of the unit disc beyond h in the direction of the tilt: its area over the disc's, and the distance of
/// its centroid from the disc's centre.
struct DiscSegment
{
  double h = -1, area = 1, centroid = 0;

  static DiscSegment beyond(double h)
  {
    const double w = std::sqrt(std::max(0.0, 1.0 - h * h)), zeroth = std::acos(h) - h * w;
    return {h, zeroth / M_PI, 2.0 / 3.0 * w * w * w / zeroth};
  }
  /// A lower bound of the area of the segment of this centroid; for a small segment the area goes as (1 - c)^1.5.
  static double least_area(double centroid)
  {
    const double rest = std::max(0.0, 1.0 - centroid);
    return rest * std::sqrt(rest);
  }
  /// The segment of this centroid, by Newton's method between bounds, from h = `near` where one is known;
  /// beyond(smallest) is the last.
  static DiscSegment with_centroid(double centroid, double near = 2.0)
  {
    if (!(centroid > 0.0)) return {};
    if (const DiscSegment last = beyond(smallest); centroid >= last.centroid) return last;
    // the limits of a small and of a large h: c = 4 sqrt(2)/(3 pi) (1 + h)^1.5, 1 - c = 0.6 (1 - h)
    double h = near;
    if (!(h < smallest))
      h = std::min(std::pow(0.75 * M_PI * M_SQRT1_2 * centroid, 2.0 / 3.0) - 1.0, 1.0 - (1.0 - centroid) / 0.6);
    double low = -1.0, high = smallest;
    for (int step = 0; step < 40; ++step) {
      if (!(h > low && h < high)) h = 0.5 * (low + high);
      const DiscSegment now = beyond(h);
      const double miss = now.centroid - centroid;
      if (std::abs(miss) < 1e-7 || high - low < 1e-12) return now;
      (miss > 0 ? high : low) = h;
      // d(centroid)/dh = 2 w (centroid - h)/(area of the segment)
      h -= miss * M_PI * now.area / (2.0 * std::sqrt(1.0 - h * h) * (now.centroid - h));
    }
    return beyond(h);
  }

 private:
  static constexpr double smallest = 0.999;
};

/// Flow of a segment. The surface beyond eta moves in by xi - eta, xi over the disc's radius from its centre in
/// the direction of the tilt. As a plane A + B xi over the segment, by least squares; nothing moves out: where eta
/// lies before the segment, the plane ends at its edge, which is the normal of the segment's yield curve.
struct DentFlow
{
  double deepening, turning, mean;  ///< A, B, and the mean of xi - eta where it is positive

  static DentFlow of(const DiscSegment& segment, double eta)
  {
    const double h = segment.h, from = std::max(h, std::min(eta, largest_eta));
    if (from <= h) return {-h, 1.0, segment.centroid - h};
    const Moments all = Moments::beyond(h), part = Moments::beyond(from);
    const double f0 = part.first - from * part.zeroth, f1 = part.second - from * part.first;
    const double determinant = all.zeroth * all.second - all.first * all.first;
    return {(all.second * f0 - all.first * f1) / determinant, (all.zeroth * f1 - all.first * f0) / determinant,
            f0 / all.zeroth};
  }

 private:
  /// Beyond, so little moves in that A : B is what remains to know, and it hardly changes.
  static constexpr double largest_eta = 0.95;

  /// Integrals of 1, xi, xi^2 over the disc beyond h.
  struct Moments
  {
    double zeroth, first, second;

    static Moments beyond(double h)
    {
      const double w = std::sqrt(std::max(0.0, 1.0 - h * h)), angle = std::acos(h);
      return {angle - h * w, 2.0 / 3.0 * w * w * w, 0.25 * (angle + h * w * (1.0 - 2.0 * h * h))};
    }
  };
};

/// Yield of a contact under its normal force and a shear T: F = s(q) F_m, q = T/T_0, s = 1 - c + c (1 - q^2)^m. It
/// flows along the curve's normal: sliding over deepening = F_m/T_0 (-ds/dq).
struct ShearYield
{
  static constexpr double normal_loss = 0.5;  ///< c: slip lines under a flat punch that slides leave half of F_m
  static constexpr double exponent = 0.35;    ///< m: c m as of the ellipse c = 0.35 m = 0.5, fitted to small shear

  /// Not above share(), without a power.
  static double least_share(double q) { return 1.0 - normal_loss + normal_loss * std::sqrt(std::max(0.0, 1.0 - q * q)); }
  static double share(double q)
  {
    return 1.0 - normal_loss + normal_loss * std::pow(std::max(0.0, 1.0 - q * q), exponent);
  }
  /// q, s and -ds/dq.
  struct Point
  {
    double q, share, fall;
  };
  static double tau(double q) { return q / std::sqrt(1.0 - q * q); }
  /// At q = tau/sqrt(1 + tau^2).
  static Point at_tau(double tau)
  {
    if (std::isinf(tau)) return {1.0, 1.0 - normal_loss, tau};  // sliding at T_0 alone
    const double t2 = 1.0 + tau * tau, root = std::sqrt(t2), power = std::pow(t2, 0.5 - exponent);
    return {tau / root, 1.0 - normal_loss + normal_loss * power / root, two_cm * tau * power};
  }
  /// tau where the force of a spring, `pull` before, is what the flow has left of it: T_0 q = pull - give (-ds/dq).
  /// Newton's method in tau, where the equation is nearly linear; from `near` where one is known.
  static double tau_of(double pull, double strength, double give, double near = -1.0)
  {
    const double q = pull / strength;
    if (!(give > 0.0)) return q < 1.0 ? tau(q) : std::numeric_limits<double>::infinity();
    double tau = near;
    if (!(tau >= 0.0 && tau < 1e100)) {
      tau = pull / (strength + two_cm * give);
      if (q > 1.0) tau = std::max(tau, std::pow((pull - strength) / (two_cm * give), 0.5 / (1.0 - exponent)));
    }
    for (int step = 0; step < 30; ++step) {
      const double t2 = 1.0 + tau * tau, root = std::sqrt(t2), power = std::pow(t2, 0.5 - exponent);
      const double miss = strength * tau / root + give * two_cm * tau * power - pull;
      const double slope =
          strength / (t2 * root) + give * two_cm * power * (1.0 + (1.0 - 2.0 * exponent) * tau * tau / t2);
      const double before = tau;
      tau = std::max(0.0, tau - miss / slope);
      if (std::abs(tau - before) <= 1e-5 * (1.0 + tau)) break;  // of the second order: the error is its square
    }
    return tau;
  }

 private:
  static constexpr double two_cm = 2.0 * exponent * normal_loss;
};

}  // namespace granulaw
