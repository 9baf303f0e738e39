#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
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
///     span      1 - rho, rho = x_r/x_m: a reversal at x_m unloads along u = 1 - (x_m - x)/(span x_m)
///     exponent  n, and Hertz share A
///     work      W_load - W_unload: spent on plastic strain (quasi-static)
/// One cache line for the loading branch, three for a reversal, none for a reversal that was kept. A velocity
/// axis is laid out anew: FastAxis. Below 2^-40 and beyond x_end the curve itself answers. Errors against the
/// curve: tests/unit/fast_curve_test.cpp; speed: tests/benchmarks/law_benchmark.cpp.
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
    return unloads(x, x_max) ? reversal(x_max, impact_overlap).force_at(x) : loading_force(x, impact_overlap);
  }

  /// Force and its derivative by x.
  struct Response
  {
    double force = 0, stiffness = 0;
  };

  /// A reversal at x_max: all that un- and reloading below it takes, worked out once. A contact that keeps it
  /// needs no table for its force until it loads further. In the curve's units.
  struct Reversal
  {
    double x_max = 0;      ///< 0: none yet
    double per_range = 0;  ///< 1/(x_m - x_r): u = 1 - (x_m - x) per_range
    double force[3] = {};  ///< of u^1.5, u^2 and u^2.5: F_m times A, B and C of UnloadingShape

    double force_at(double x) const
    {
      const double u = part(x);
      return u <= 0.0 ? 0.0 : force_at(u, std::sqrt(u));
    }
    Response response_at(double x) const
    {
      const double u = part(x);
      if (u <= 0.0) return {};
      const double root = std::sqrt(u);
      return {force_at(u, root), per_range * slope_at(u, root)};
    }
    /// Given back on complete unloading.
    double work() const { return (0.4 * force[0] + 1.0 / 3.0 * force[1] + 2.0 / 7.0 * force[2]) / per_range; }

    double part(double x) const { return 1.0 - (x_max - x) * per_range; }  ///< u; negative: parted
    double force_at(double u, double root) const
    {
      return u * root * ((force[0] + root * force[1]) + u * force[2]);
    }
    /// dF/du; at u = 1 it is F_m n.
    double slope_at(double u, double root) const
    {
      return root * ((1.5 * force[0] + root * (2.0 * force[1])) + u * (2.5 * force[2]));
    }
  };
  /// True if a contact at x follows the reversal at x_max; else it loads, or never yielded. Of no number:
  /// true, so that its force is none.
  bool unloads(double x, double x_max) const { return !(x >= x_max) && !(x_max <= onset_); }
  double loading_force(double x, double impact_overlap = 0) const
  {
    if (!in_table(x)) [[unlikely]]
      return far_loading(x, impact_overlap).force;
    const double slow = at(x).force();
    return corrected(impact_overlap) ? slow * (1.0 + axis_.force(x, impact_overlap).value) : slow;
  }
  Response loading_response(double x, double impact_overlap = 0) const
  {
    if (!in_table(x)) [[unlikely]] {
      const ContactCurve::Loading far = far_loading(x, impact_overlap);
      return {far.force, far.stiffness};
    }
    const Place p = at(x);
    const double slow = p.force(), slope = p.i.loading.first_slope(p.t);
    if (!corrected(impact_overlap)) return {slow, slope};
    const VelocityAxis::ForceCorrection a = axis_.force(x, impact_overlap);
    return {slow * (1.0 + a.value), slope * (1.0 + a.value) + slow * a.slope};
  }
  Reversal reversal(double x_max, double impact_overlap = 0) const
  {
    if (!in_table(x_max)) [[unlikely]]
      return far_turn(x_max, impact_overlap);
    const Place p = at(x_max);
    const Two rest = p.i.reversal.both(p.t);
    double force = p.force(), span = rest[0];
    UnloadingShape shape{rest[1], std::max(p.i.rest.first(p.t), 0.0)};
    if (corrected(impact_overlap)) {
      const VelocityAxis::ReversalCorrection c = axis_.reversal(x_max, impact_overlap);
      force *= 1.0 + c.force;
      span = c.corrected_span(span);
      shape = c.corrected_shape(shape);
    }
    return turn_of(x_max, force, span * x_max, shape);
  }

  /// Force, stiffness and contact radius in the curve's units, as ContactCurve::evaluate.
  ContactCurve::Loading evaluate(double x, double x_max, double impact_overlap = 0) const
  {
    return unloads(x, x_max) ? evaluate(x, reversal(x_max, impact_overlap)) : loading(x, impact_overlap);
  }
  /// The same of a contact that unloads and has kept its reversal.
  ContactCurve::Loading evaluate(double x, const Reversal& reversal) const
  {
    const double u = reversal.part(x);
    if (u <= 0.0) return {0.0, 0.0, 0.0};
    const double root = std::sqrt(u), slope = reversal.slope_at(u, root);
    // a = a_m phi'(u)/phi'(1)
    return {reversal.force_at(u, root), slope * reversal.per_range,
            radius(reversal.x_max) * slope / reversal.slope_at(1.0, 1.0)};
  }
  /// As ContactCurve::evaluate: SI.
  ContactForce evaluate(const PairMapping& pair, double r_eff, double delta, double delta_max,
                        double impact_overlap = 0) const
  {
    const double per_length = 1.0 / pair.length(r_eff), force_scale = pair.force(r_eff);
    const ContactCurve::Loading now = evaluate(delta * per_length, delta_max * per_length, impact_overlap);
    return {force_scale * now.force, force_scale * per_length * now.stiffness,
            pair.radius(r_eff) * now.radius, std::max(delta, delta_max)};
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
  double dissipated(double from, double to, double impact_overlap) const
  {
    if (corrected(impact_overlap)) [[unlikely]]
      return dissipated_fast(from, to, impact_overlap);
    return dissipated(to) - dissipated(from);
  }

 private:
  static constexpr int bits_per_octave = 3, lowest_exponent = -40;
  static constexpr int shift = 52 - bits_per_octave;
  struct Interval
  {
    CubicPair loading;   // force, radius
    CubicPair reversal;  // span, exponent
    CubicPair rest;      // Hertz share, work
  };

  struct Place
  {
    const Interval& i;
    double t;
    double force() const { return i.loading.first(t); }
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
    const VelocityAxis::ForceCorrection a = axis_.force(x, impact_overlap);
    return {force * (1.0 + a.value), stiffness * (1.0 + a.value) + force * a.slope, now[1]};
  }
  double radius(double x) const
  {
    if (!in_table(x)) [[unlikely]]
      return far_loading(x, 0.0).radius;
    const Place p = at(x);
    return p.i.loading.both(p.t)[1];
  }
  static Reversal turn_of(double x_max, double force, double range, const UnloadingShape& shape)
  {
    return {x_max, 1.0 / range, {force * shape.hertz_share, force * shape.second(), force * shape.third()}};
  }
  /// dissipated() with X > 0.
  double dissipated_fast(double from, double to, double impact_overlap) const;
  /// Loading work with an axis, to 1e-4 of itself.
  double loading_work(double x, double impact_overlap) const;
  // Beyond the table, out of line: the loop stays small.
  ContactCurve::Loading far_loading(double x, double impact_overlap) const;
  Reversal far_turn(double x_max, double impact_overlap) const;

  std::vector<Interval> intervals_;
  const ContactCurve* curve_ = nullptr;
  FastAxis axis_;             // the curve's
  std::uint64_t places_ = 0;  // of x_end, and one; 0: no table
  double onset_ = 0;
  double corrected_from_ = std::numeric_limits<double>::infinity();  // infinity: no axis
};

}  // namespace granulaw
