#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contact/cubic.hpp"
#include "contact/pair.hpp"
#include "contact/unloading.hpp"
#include "law/velocity_axis.hpp"

namespace granulaw {

/// The dimensionless contact law of one yielding body, tabulated.
///
/// What is stored. Five functions of one overlap x = delta/(lambda R*), each as ratio to the Hertz value or
/// as a pure number, at nodes uniform in s = x^(1/4), s_k = k s_end/(count-1), k = 0..count-1:
///     force_ratio[k]     g = F_L(x) / F_Hertz(x)                  loading force;       g(0) = 1
///     residual_ratio[k]  rho = delta_r/delta_m                    residual overlap after a reversal at x
///     exponent[k]        n   unloading F = F_L(delta_m) phi(u), u = (delta - delta_r)/(delta_m - delta_r),
///     hertz_share[k]            A   phi by n and A: UnloadingShape
///     radius_ratio[k]    a(x) / a_Hertz(x), a_Hertz = R sqrt(x)   contact radius;      1 at x = 0
/// Between nodes: cubic Hermite with the stored slopes (d/ds), so F, dF/dx are continuous.
/// Half-open range 0 <= x < x_end = s_end^4. Beyond it the force goes on with the last stiffness, the other
/// four keep their last value, and `in_range` says false: the caller counts and decides.
///
/// State of a contact: delta_max, the largest overlap since first touch, and, where the curve has a velocity
/// axis, the impact overlap X latched at first touch (velocity_axis.hpp; dimensionless as x). The caller
/// zeroes both when the geometric overlap ends. delta >= delta_max: loading. Else unloading and reloading
/// follow the same curve F = F_L(delta_max) phi(u), 0 for u < 0. While delta_max is below the onset of yield,
/// F = F_L(delta) both ways.
///
/// X = 0, which every function takes for the argument left out, is the quasi-static law, to the bit the law
/// of a curve without an axis. Else F_L, rho and n have the corrections of x/X and X; A has none.
///
/// Admissible (no closed cycle gains energy) if dW_L/d(delta_m) >= dW_u/d(delta_m): see
/// admissibility_margin().
class ContactCurve
{
 public:
  /// Node values as stored in a file. All vectors have the same length, at least 4.
  struct Table
  {
    double s_end = 0;  ///< s at the last node; x_end = s_end^4
    double onset = 0;  ///< x at which yield begins; infinity: never (elastic)
    std::vector<double> force_ratio, force_ratio_slope;  ///< value and d/ds
    std::vector<double> residual_ratio, residual_ratio_slope;
    std::vector<double> exponent, exponent_slope;
    std::vector<double> hertz_share, hertz_share_slope;
    std::vector<double> radius_ratio, radius_ratio_slope;
  };

  ContactCurve() = default;
  /// Throws Error naming `where` if a length, a value at a node or a cubic between nodes is out of range,
  /// or if the force falls at the end. What is accepted evaluates to finite, never negative forces.
  ContactCurve(const Table& table, const std::string& where);
  /// With a velocity axis. Further refused: an axis whose X_end lies over 5 % beyond x_end, and, at its
  /// levels and half-way between them (sampled eight times an interval), a loading force that falls or a
  /// corrected residual ratio or exponent as no curve may have.
  ContactCurve(const Table& table, const VelocityAxis::Table& axis, const std::string& where);

  /// Largest dimensionless overlap of the table.
  double x_end() const { return x_end_; }
  bool in_range(double x) const { return x <= x_end_; }
  double onset() const { return onset_; }
  const Table& table() const { return table_; }
  /// Null: the law is quasi-static.
  const VelocityAxis* axis() const { return axis_ ? &*axis_ : nullptr; }

  /// Loading force over Hertz's force at x = 1, that is x^1.5 g(x); its derivative by x; a/R = sqrt(x) ratio.
  struct Loading
  {
    double force, stiffness, radius;
  };
  Loading loading(double x, double impact_overlap = 0) const;

  /// Reversal point of a contact that reached x_m.
  struct Reversal
  {
    double force, stiffness, radius, residual;
    UnloadingShape shape;
  };
  Reversal reversal(double x_m, double impact_overlap = 0) const;

  /// Work of loading to x, and work given back on complete unloading from x_m, in units of
  /// (Hertz force at x = 1) * length. With X > 0 the loading work is integrated anew: microseconds.
  double work_loading(double x, double impact_overlap = 0) const;
  std::vector<double> work_loading(std::span<const double> ascending, double impact_overlap) const;
  double work_unloading(double x_m, double impact_overlap = 0) const;

  /// min over the table of (F_L - dW_u/d x_m)/F_L, and of (W_L - W_u)/W_L just past the onset; negative: some
  /// closed cycle would gain energy. Infinity: the table ends before the onset. Without an argument: the
  /// least of the quasi-static law, every level of the axis and half-way between levels.
  double admissibility_margin() const;
  double admissibility_margin(double impact_overlap) const;
  /// (F_L - dW_u/d x_m)/F_L at x; infinity within 1e-4 of the onset and the table's end, below and beyond
  /// them.
  double margin_at(double x, double impact_overlap) const;
  /// Where admissibility_margin(X) takes it.
  std::vector<double> margin_overlaps(double impact_overlap) const;

  /// The law: force, stiffness and contact radius of a pair at overlap `delta` (m, > 0) whose largest overlap
  /// so far is `delta_max` (m). No allocation, no branch on strings, no exceptions.
  ContactForce evaluate(const PairMapping& pair, double r_eff, double delta, double delta_max,
                        double impact_overlap = 0) const;

 private:
  /// Cubic coefficients in t = (s - s_k)/h of the five functions over one interval.
  struct Interval
  {
    double g[4], a[4], rho[4], n[4], hertz_share[4];
  };
  struct Position
  {
    const Interval* interval;
    double t, s, root;
  };

  Position locate(double x) const
  {
    const double root = std::sqrt(x), s = std::sqrt(root);
    const double position = s * per_h_;
    const std::size_t last = intervals_.size() - 1;  // of no number, too
    const std::size_t k =
        position < static_cast<double>(last) ? static_cast<std::size_t>(position) : last;
    return {&intervals_[k], position - static_cast<double>(k), s, root};
  }
  /// Between nodes the cubic of the Hertz share may pass below 0 by rounding.
  static UnloadingShape shape_at(const Position& p)
  {
    return {cubic(p.interval->n, p.t), std::max(cubic(p.interval->hertz_share, p.t), 0.0)};
  }
  bool corrected(double impact_overlap) const { return axis_ && impact_overlap > VelocityAxis::negligible; }
  Loading quasi_static(double x) const;
  /// Loading work from node k to t_end within its interval.
  double interval_work(std::size_t k, double t_end) const;
  double quasi_static_work(double x) const;
  /// Work of the axis's part of the loading force.
  double correction_work(double from, double to, double impact_overlap) const;
  void check_unloading_rises(const std::string& where) const;
  void check_axis(const std::string& where) const;

  std::vector<Interval> intervals_;
  std::vector<double> work_;  // loading work up to each node
  double per_h_ = 0;          // 1/(node spacing in s)
  double x_end_ = 0;
  double onset_ = 0;
  Loading end_{};  // loading at x_end
  Table table_;
  std::optional<VelocityAxis> axis_;
};

inline ContactCurve::Loading ContactCurve::quasi_static(double x) const
{
  if (x > x_end_) [[unlikely]]
    return {end_.force + end_.stiffness * (x - x_end_), end_.stiffness, end_.radius * std::sqrt(x / x_end_)};
  const Position p = locate(x);
  const double g = cubic(p.interval->g, p.t);
  const double dg = cubic_slope(p.interval->g, p.t) * per_h_;
  // F = x^1.5 g, ds/dx = s/(4x): dF/dx = sqrt(x) (1.5 g + s g'/4)
  return {x * p.root * g, p.root * (1.5 * g + 0.25 * p.s * dg), p.root * cubic(p.interval->a, p.t)};
}

inline ContactCurve::Loading ContactCurve::loading(double x, double impact_overlap) const
{
  const Loading slow = quasi_static(x);
  if (!corrected(impact_overlap)) return slow;
  // F = F_qs (1 + A): dF/dx = F_qs' (1 + A) + F_qs dA/dx
  const VelocityAxis::ForceCorrection a = axis_->force(x, impact_overlap);
  return {slow.force * (1.0 + a.value), slow.stiffness * (1.0 + a.value) + slow.force * a.slope, slow.radius};
}

inline ContactCurve::Reversal ContactCurve::reversal(double x_m, double impact_overlap) const
{
  const Loading top = loading(x_m, impact_overlap);
  const Position p = locate(std::min(x_m, x_end_));
  double ratio = cubic(p.interval->rho, p.t);
  UnloadingShape shape = shape_at(p);
  if (corrected(impact_overlap)) {
    const VelocityAxis::ReversalCorrection reversal = axis_->reversal(x_m, impact_overlap);
    ratio = reversal.corrected_residual(ratio);
    shape = reversal.corrected_shape(shape);
  }
  return {top.force, top.stiffness, top.radius, x_m * ratio, shape};
}

inline ContactForce ContactCurve::evaluate(const PairMapping& pair, double r_eff, double delta,
                                           double delta_max, double impact_overlap) const
{
  const double length = pair.length(r_eff), per_length = 1.0 / length;
  const double force_scale = pair.force(r_eff), radius_scale = pair.radius(r_eff);
  const double x = delta * per_length, x_max = delta_max * per_length;
  if (x >= x_max || x_max <= onset_) {
    const Loading now = loading(x, impact_overlap);
    return {force_scale * now.force, force_scale * per_length * now.stiffness, radius_scale * now.radius,
            std::max(delta, delta_max)};
  }
  // reversal(x_max) without what is not needed, from one position: this branch is where a dense flow spends
  // its time
  const Position p = locate(std::min(x_max, x_end_));
  double residual = cubic(p.interval->rho, p.t);  // over delta_max
  UnloadingShape shape = shape_at(p);
  double top = x_max <= x_end_ ? x_max * p.root * cubic(p.interval->g, p.t)
                               : end_.force + end_.stiffness * (x_max - x_end_);
  if (corrected(impact_overlap)) {
    const VelocityAxis::ReversalCorrection reversal = axis_->reversal(x_max, impact_overlap);
    top *= 1.0 + reversal.force;
    residual = reversal.corrected_residual(residual);
    shape = reversal.corrected_shape(shape);
  }
  const double span = 1.0 - residual, u = (delta / delta_max - residual) / span;
  if (u <= 0.0) return {0.0, 0.0, 0.0, delta_max};
  const double top_radius =
      p.root * cubic(p.interval->a, p.t) * (x_max <= x_end_ ? 1.0 : std::sqrt(x_max / x_end_));
  // a = a_m phi'(u)/phi'(1): dF/dx = 2 E* a keeps its ratio
  const auto [value, slope] = shape.at(u);
  return {force_scale * top * value, force_scale * per_length * top * slope / (span * x_max),
          radius_scale * top_radius * slope / shape.exponent, delta_max};
}

}  // namespace granulaw
