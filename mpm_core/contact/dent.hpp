#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
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
  /// The segment of this centroid; of a centroid beyond `largest`, that one.
  static DiscSegment with_centroid(double centroid)
  {
    if (!(centroid > 0.0)) return {};
    const double c = std::min(centroid, largest), u = std::sqrt(c), rest = 1.0 - c;
    const Table::Point ratio = by_centroid.at(u);
    // d(area)/dc = -area/(c - h)
    return {c + rest * ratio.value / (rest * ratio.slope / (2.0 * u) - 1.5 * ratio.value), ratio.value * least_area(c), c};
  }
  /// Its area alone.
  static double area_of(double centroid)
  {
    if (!(centroid > 0.0)) return 1.0;
    const double c = std::min(centroid, largest);
    return by_centroid.at(std::sqrt(c)).value * least_area(c);
  }

 private:
  static constexpr double largest = 0.9994;  // h = 0.999

  /// Area over least_area(), by the root of the centroid: cubic Hermite between nodes, the area to 1e-7.
  struct Table
  {
    static constexpr int cells = 64;
    double value[cells + 1], slope[cells + 1];

    Table()
    {
      value[0] = 1.0, slope[0] = 0.0;
      for (int k = 1; k <= cells; ++k) {
        const double u = static_cast<double>(k) / cells, c = std::min(u * u, largest);
        double low = -1.0, high = 1.0;
        for (int bisection = 0; bisection < 50; ++bisection) {
          const double h = 0.5 * (low + high);
          (beyond(h).centroid > c ? high : low) = h;
        }
        const DiscSegment found = beyond(low);
        value[k] = found.area / least_area(c);
        slope[k] = 2.0 * std::sqrt(c) * value[k] * (1.5 / (1.0 - c) - 1.0 / (c - found.h));
      }
    }
    struct Point
    {
      double value, slope;
    };
    Point at(double u) const
    {
      const double place = u * cells;
      const int k = std::min(static_cast<int>(place), cells - 1);
      const double t = place - k, v0 = value[k], rise = value[k + 1] - v0, s0 = slope[k] / cells, s1 = slope[k + 1] / cells;
      const double second = 3.0 * rise - 2.0 * s0 - s1, third = s0 + s1 - 2.0 * rise;
      return {v0 + t * (s0 + t * (second + t * third)), (s0 + t * (2.0 * second + t * 3.0 * third)) * cells};
    }
  };
  static const Table by_centroid;
};
inline const DiscSegment::Table DiscSegment::by_centroid{};

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
    const Moments all = Moments::of(segment), part = Moments::of(DiscSegment::beyond(from));
    const double f0 = part.first - from * part.zeroth, f1 = part.second - from * part.first;
    const double determinant = all.zeroth * all.second - all.first * all.first;
    return {(all.second * f0 - all.first * f1) / determinant, (all.zeroth * f1 - all.first * f0) / determinant,
            f0 / all.zeroth};
  }

 private:
  /// Beyond, so little moves in that A : B is what remains to know, and it hardly changes.
  static constexpr double largest_eta = 0.95;

  /// Integrals of 1, xi, xi^2 over a segment.
  struct Moments
  {
    double zeroth, first, second;

    static Moments of(const DiscSegment& s)
    {
      const double zeroth = M_PI * s.area, hw = s.h * std::sqrt(std::max(0.0, 1.0 - s.h * s.h));
      return {zeroth, zeroth * s.centroid, 0.25 * (zeroth + 2.0 * hw * (1.0 - s.h * s.h))};  // zeroth: acos h - h w
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
    const double rest = std::max(0.0, 1.0 - q * q);
    return 1.0 - normal_loss + (rest > 0.0 ? normal_loss * std::sqrt(rest) * root_power(1.0 / rest) : 0.0);
  }
  /// tau = q/sqrt(1 - q^2), in which a flow under a spring is nearly linear.
  static double tau_of(double q) { return q < 1.0 ? q / std::sqrt(1.0 - q * q) : std::numeric_limits<double>::infinity(); }
  /// q, s and -ds/dq at tau.
  struct Point
  {
    double tau, q, share, fall, power, root;

    explicit Point(double at) : tau(at), q(1.0), share(1.0 - normal_loss), fall(at), power(at), root(at)
    {
      if (std::isinf(tau)) return;  // sliding at T_0 alone
      const double t2 = 1.0 + tau * tau;
      root = std::sqrt(t2), power = root_power(t2);
      q = tau / root, share = 1.0 - normal_loss + normal_loss * power / root, fall = two_cm * tau * power;
    }
    /// The point where the force of a spring, `pull` before over T_0, is what the flow has left of it: q = pull - give fall.
    /// Newton's method from here, to `within` of 1 + tau; the error is its square.
    Point under(double pull, double give, double within) const
    {
      if (!(give > 0.0)) return Point(tau_of(pull));
      Point now = *this;
      if (!(now.tau < 1e100)) {
        double start = pull / (1.0 + two_cm * give);
        if (pull > 1.0) start = std::max(start, std::pow((pull - 1.0) / (two_cm * give), 0.5 / (1.0 - exponent)));
        now = Point(start);
      }
      for (int step = 0; step < 30; ++step) {
        const double before = now.tau, per_root = 1.0 / now.root, part = now.q * now.q;
        const double slope = per_root * per_root * per_root + give * two_cm * now.power * (1.0 + (1.0 - 2.0 * exponent) * part);
        now = Point(std::max(0.0, before - (now.q + give * now.fall - pull) / slope));
        if (!(std::abs(now.tau - before) > within * (1.0 + now.tau))) break;
      }
      return now;
    }
  };

 private:
  static constexpr double two_cm = 2.0 * exponent * normal_loss;

  /// x^(1/2 - m) of x >= 1 to 2e-6: of its power of two by table, of the rest by the binomial series about 3/2.
  static double root_power(double x)
  {
    constexpr double power = 0.5 - exponent;
    constexpr int powers = 64, terms = 7;
    static const auto of_two = [] {
      std::array<double, powers> value;
      for (int k = 0; k < powers; ++k) value[k] = std::pow(1.5 * std::ldexp(1.0, k), power);
      return value;
    }();
    static constexpr auto binomial = [] {
      std::array<double, terms + 1> value{1.0};
      for (int k = 1; k <= terms; ++k) value[k] = value[k - 1] * (power - k + 1) / (k * 1.5);
      return value;
    }();
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t k = (bits >> 52) - 1023;
    if (!(k < powers)) return std::pow(x, power);
    const double rest = std::bit_cast<double>((bits & ((1ULL << 52) - 1)) | (1023ULL << 52)) - 1.5;
    const double rest2 = rest * rest;
    const auto pair = [&](int term) { return binomial[term] + binomial[term + 1] * rest; };
    return of_two[k] * ((pair(0) + rest2 * pair(2)) + rest2 * rest2 * (pair(4) + rest2 * pair(6)));
  }
};

}  // namespace granulaw
