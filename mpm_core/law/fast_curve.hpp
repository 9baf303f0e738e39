#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "law/contact_curve.hpp"
#include "law/fast_axis.hpp"

namespace granulaw {

/// A ContactCurve re-tabulated for the contact loop of a particle code: no square root on the way to the
/// interval.
///
/// Nodes divide each octave of x = overlap/(lambda R*) into 8 equal parts from 2^-40 up to x_end, so that the
/// bits of x give the interval and the node below x. In each interval cubics in the distance t of x from that
/// node, in the curve's units (Hertz force at x = 1):
///     force     F_L(x)           Hermite with the curve's stiffness: the stiffness is its derivative,
///                                exactly, and continuous
///     radius    a(x)             this and the following: equal to the curve at four equidistant points
///     span      1 - rho, rho = x_r/x_m: a turn at x_m unloads along u = (span - (1 - x/x_m))/span
///     exponent  n, and foot A
///     work      W_load - W_unload: spent on plastic strain (quasi-static)
/// One cache line for the loading branch, three for unloading. An inertia axis is laid out anew: FastAxis.
/// Below 2^-40 and beyond x_end the curve itself answers. Errors against the curve:
/// tests/unit/fast_curve_test.cpp; speed: tests/benchmarks/law_benchmark.cpp.
///
/// The arguments x, x_max and impact_overlap (X; 0: quasi-static) are ContactCurve's.
class FastCurve
{
 public:
  FastCurve() = default;
  /// Keeps a pointer to `curve`, which must outlive this and stay where it is.
  explicit FastCurve(const ContactCurve& curve);

  const ContactCurve& curve() const { return *curve_; }
  /// Bytes of what evaluation reads, axis included.
  std::size_t bytes() const;

  /// Force alone, in the curve's units.
  double force(double x, double x_max, double impact_overlap = 0) const
  {
    if (x >= x_max || x_max <= onset_) {
      if (!in_table(x)) [[unlikely]]
        return far_loading(x, impact_overlap).force;
      const double slow = at(x).force();
      return corrected(impact_overlap) ? slow * (1.0 + axis_.force(x, impact_overlap).value) : slow;
    }
    if (!in_table(x_max)) [[unlikely]]
      return far_unloading(x, x_max, impact_overlap);
    const Place p = at(x_max);
    const Turn turn = turn_at(p, p.force(), x_max, impact_overlap);
    const double rest = turn.span - (x_max - x) / x_max;
    return rest <= 0.0 ? 0.0 : turn.force * turn.at(rest, 1.0 / turn.span).value;
  }

  /// As ContactCurve::evaluate.
  ContactForce evaluate(const PairMapping& pair, double r_eff, double delta, double delta_max,
                        double impact_overlap = 0) const
  {
    const double length = pair.length(r_eff), per_length = 1.0 / length;
    const double force_scale = pair.force(r_eff), radius_scale = pair.radius(r_eff);
    const double x = delta * per_length, x_max = delta_max * per_length;
    if (x >= x_max || x_max <= onset_) {
      const ContactCurve::Loading now = loading(x, impact_overlap);
      return {force_scale * now.force, force_scale * per_length * now.stiffness, radius_scale * now.radius,
              std::max(delta, delta_max)};
    }
    if (!in_table(x_max)) [[unlikely]]
      return far_evaluate(pair, r_eff, delta, delta_max, impact_overlap);
    const Place p = at(x_max);
    const Two top = p.i.loading.both(p.t);
    const Turn turn = turn_at(p, top[0], x_max, impact_overlap);
    const double per_delta_max = 1.0 / delta_max, rest = turn.span - (delta_max - delta) * per_delta_max;
    if (rest <= 0.0) return {0.0, 0.0, 0.0, delta_max};
    const double per_span = 1.0 / turn.span;
    const auto [value, slope] = turn.at(rest, per_span);
    // a = a_m phi'(u)/phi'(1), as ContactCurve
    const double force = force_scale * turn.force, radius = radius_scale * top[1] / turn.shape.exponent;
    return {force * value, force * per_delta_max * per_span * slope, radius * slope, delta_max};
  }

  /// Work spent on plastic strain by a quasi-static contact whose largest overlap is x_max: a function of
  /// x_max alone, because unloading and reloading share a curve.
  double dissipated(double x_max) const
  {
    if (x_max <= onset_) return 0.0;
    return in_table(x_max) ? work(x_max) : curve_->work_loading(x_max) - curve_->work_unloading(x_max);
  }
  /// Work spent on plastic strain while the largest overlap grew from `from` to `to`. With X > 0 the loading
  /// work between is Simpson's rule, exact to 1e-4 of itself for steps of up to a quarter; longer ones, and
  /// the one across the onset, are integrated.
  double dissipated(double from, double to, double impact_overlap) const;

 private:
  static constexpr int bits_per_octave = 3, lowest_exponent = -40;
  static constexpr int shift = 52 - bits_per_octave;
  struct Interval
  {
    CubicPair loading;  // force, radius
    CubicPair turn;     // span, exponent
    CubicPair rest;     // foot, work
  };

  struct Place
  {
    const Interval& i;
    double t;
    double force() const { return i.loading.first(t); }
  };
  struct Turn
  {
    double force, span;
    UnloadingShape shape;

    /// At u = rest/span > 0. sqrt(u) so that root and division run side by side.
    UnloadingShape::Point at(double rest, double per_span) const
    {
      return shape.at(rest * per_span, std::sqrt(rest * span) * per_span);
    }
  };

  static constexpr std::uint64_t first_bits = static_cast<std::uint64_t>(1023 + lowest_exponent) << 52;
  /// Rises with x >= 2^-40; larger than of any such x for all else, NaN included.
  static std::uint64_t place(double x) { return std::bit_cast<std::uint64_t>(x) - first_bits; }
  static std::size_t index(double x) { return place(x) >> shift; }
  /// The node at or below x.
  static double node(double x)
  {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) >> shift << shift);
  }

  bool in_table(double x) const { return place(x) < places_; }
  bool corrected(double impact_overlap) const { return impact_overlap > corrected_from_; }
  Place at(double x) const { return {intervals_[index(x)], x - node(x)}; }
  double work(double x) const
  {
    const Place p = at(x);
    return p.i.rest.both(p.t)[1];
  }

  ContactCurve::Loading loading(double x, double impact_overlap) const
  {
    if (!in_table(x)) [[unlikely]]
      return far_loading(x, impact_overlap);
    const Place p = at(x);
    const Two now = p.i.loading.both(p.t);
    const double force = now[0], stiffness = p.i.loading.first_slope(p.t);
    if (!corrected(impact_overlap)) return {force, stiffness, now[1]};
    const InertiaAxis::ForceCorrection a = axis_.force(x, impact_overlap);
    return {force * (1.0 + a.value), stiffness * (1.0 + a.value) + force * a.slope, now[1]};
  }
  Turn turn_at(const Place& p, double force, double x_max, double impact_overlap) const
  {
    const Two turn = p.i.turn.both(p.t);
    const UnloadingShape shape{turn[1], std::max(0.0, p.i.rest.first(p.t))};
    if (!corrected(impact_overlap)) return {force, turn[0], shape};
    const InertiaAxis::TurnCorrection c = axis_.turn(x_max, impact_overlap);
    return {force * (1.0 + c.force), c.corrected_span(turn[0]), c.corrected_shape(shape)};
  }
  // Beyond the table, out of line: the loop stays small.
  ContactCurve::Loading far_loading(double x, double impact_overlap) const;
  double far_unloading(double x, double x_max, double impact_overlap) const;
  ContactForce far_evaluate(const PairMapping& pair, double r_eff, double delta, double delta_max,
                            double impact_overlap) const;

  std::vector<Interval> intervals_;
  const ContactCurve* curve_ = nullptr;
  FastAxis axis_;             // the curve's
  std::uint64_t places_ = 0;  // of x_end, and one; 0: no table
  double onset_ = 0;
  double corrected_from_ = std::numeric_limits<double>::infinity();  // infinity: no axis
};

}  // namespace granulaw
