#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "contact/axis.hpp"
#include "contact/cubic.hpp"
#include "contact/unloading.hpp"

namespace granulaw {

/// The dimensionless contact law of one yielding body pressed slowly, as functions of the largest overlap
/// x = delta/(lambda R*) that a contact has reached; forces over Hertz's at x = 1.
///
/// Nodes x_k divide each octave of x/onset into 8 equal parts (elastic bodies: each octave of x), so that the
/// bits of x/onset are the interval, and the onset is a node. Between nodes: cubic Hermite, slopes by x.
/// Below the first node Hertz; beyond `end` the force continues with its last stiffness, the others keep
/// their last value.
struct CurveTable
{
  static constexpr int nodes_an_octave = 8;

  double onset = std::numeric_limits<double>::infinity();  ///< x at which yield begins; infinity: elastic
  double end = 0;        ///< largest x for which the law holds; between the last two nodes, or the last
  int octaves = 0;       ///< from the first node to the onset (elastic: to 1)
  HermiteColumn force;   ///< of loading; never falls
  HermiteColumn radius;  ///< contact radius over R; never falls
  // from the onset on:
  HermiteColumn kept;         ///< W_u/W_L of a reversal at x, e squared; never rises
  HermiteColumn span;         ///< 1 - delta_r/delta_m; never rises
  HermiteColumn hertz_share;  ///< A of UnloadingShape
  /// k of UnloadingRadius, linear between nodes; empty: not stated, and 1.
  std::vector<std::array<double, 3>> unloading_radius;

  CurveTable() = default;
  /// With octaves down to 2^-40, below which Hertz is exact to 1e-6. The columns are empty.
  CurveTable(double onset, double end);

  bool yields() const { return onset < end; }
  /// x where x/unit counts nodes.
  double unit() const { return std::isfinite(onset) ? onset : 1.0; }
  double node(std::size_t k) const
  {
    const auto part = static_cast<int>(k) % nodes_an_octave, octave = static_cast<int>(k) / nodes_an_octave;
    return unit() * std::ldexp(1.0 + part / double{nodes_an_octave}, octave - octaves);
  }
  /// x_k of all nodes up to the first at or beyond `end`; of `kept` and those after it.
  std::vector<double> nodes() const;
  std::vector<double> yielding_nodes() const;
};

/// A reversal: all that un- and reloading below it takes. A contact that keeps it needs no table for its
/// force until it loads further.
struct Reversal
{
  double x_max = 0;              ///< 0: none yet
  double per_span = 0;           ///< 1/(x_m - x_r): u = 1 - (x_m - x) per_span
  std::array<double, 3> term{};  ///< of u^1.5, u^2 and u^2.5: F_m times A, B and C of UnloadingShape

  double part(double x) const { return 1.0 - (x_max - x) * per_span; }  ///< u; negative: parted
  double force(double x) const
  {
    const double u = part(x);
    return u <= 0.0 ? 0.0 : force_at(u, std::sqrt(u));
  }
  double stiffness(double x) const
  {
    const double u = part(x);
    return u <= 0.0 ? 0.0 : per_span * slope_at(u, std::sqrt(u));
  }
  double force_at(double u, double root) const
  {
    return u * root * ((term[0] + root * term[1]) + u * term[2]);
  }
  /// dF/du; at u = 1 it is F_m n.
  double slope_at(double u, double root) const { return root * slope_over_root(u, root); }
  double slope_over_root(double u, double root) const
  {
    return (1.5 * term[0] + root * (2.0 * term[1])) + u * (2.5 * term[2]);
  }
  UnloadingShape shape() const { return {slope_at(1.0, 1.0) / top(), term[0] / top()}; }
  double top() const { return term[0] + term[1] + term[2]; }  ///< F_m
  double residual() const { return x_max - 1.0 / per_span; }  ///< x_r
  /// Given back from x_max, or from x on the way, to where the force ends.
  double work() const { return (0.4 * term[0] + 1.0 / 3.0 * term[1] + 2.0 / 7.0 * term[2]) / per_span; }
  double work(double x) const
  {
    const double u = part(x);
    return u <= 0.0 ? 0.0 : work_at(u, std::sqrt(u));
  }
  double work_at(double u, double root) const
  {
    return u * u * root / per_span * (0.4 * term[0] + root * (1.0 / 3.0 * term[1] + root * (2.0 / 7.0 * term[2])));
  }
};

/// Why a table is no law: `what`, and where they help, the number found and what is allowed. Empty: it is.
struct Fault
{
  std::string what{}, found{}, allowed{};
  explicit operator bool() const { return !what.empty(); }
};

/// A contact law, evaluated: force, stiffness, contact radius, energies. Arguments: x, the overlap over
/// lambda R*, and X, which the contact latched at first touch (0: slow, and always without an axis).
///
/// A contact below its largest overlap x_m unloads and reloads along F_m phi(u), whose work is kept(x_m) of
/// the work of loading; so no closed cycle gains energy where `kept` never rises. An impact to X keeps what
/// its level says; before X its loss is in the ratio of the slow press's losses, beyond X it exceeds the slow
/// press's by what it did at X. Where no unloading shape returns this work over this span, the span changes.
///
/// A value: no virtual call, and once made no allocation and no exception.
class Curve
{
 public:
  /// Share of the work that a yielded contact with X > 0 loses at least: the table of the work of loading
  /// with an axis is as good as this between levels.
  static constexpr double least_loss = 2e-4;

  static Fault fault(const CurveTable& table, const AxisTable* axis = nullptr);

  Curve() = default;
  /// Needs fault() empty.
  explicit Curve(CurveTable table, std::optional<AxisTable> axis = {});

  const CurveTable& table() const { return table_; }
  const AxisTable* axis() const { return axis_table_ ? &*axis_table_ : nullptr; }
  double end() const { return end_; }
  bool in_range(double x) const { return x <= end_; }
  double onset() const { return table_.onset; }
  std::size_t bytes() const;

  struct Loading
  {
    double force, stiffness, radius;
  };
  Loading loading(double x, double latched = 0) const
  {
    const double r = x * per_unit_;
    if (!in_table(r)) [[unlikely]]
      return far_loading(x, latched);
    const Place p = at(r);
    const Two now = p.loading.both(p.t);
    return corrected({now[0], p.loading.first_slope(p.t) * per_unit_, now[1]}, x, latched);
  }
  double force(double x, double latched = 0) const
  {
    const double r = x * per_unit_;
    if (!in_table(r)) [[unlikely]]
      return far_loading(x, latched).force;
    const Place p = at(r);
    const double slow = p.loading.first(p.t);
    return latched > corrected_from_ ? slow * (1.0 + axis_.force(x, latched).value) : slow;
  }
  double radius(double x) const
  {
    const double r = x * per_unit_;
    if (!in_table(r)) [[unlikely]]
      return far_loading(x, 0.0).radius;
    const Place p = at(r);
    return p.loading.both(p.t)[1];
  }

  /// Contact radius below a reversal at x_max, over that at x_max.
  UnloadingRadius unloading_radius(double x_max) const;
  bool states_unloading_radius() const { return !table_.yields() || !table_.unloading_radius.empty(); }

  /// True if a contact at x follows the reversal at x_max; else it loads, or never yielded. Of no number:
  /// true, so that its force is none.
  bool unloads(double x, double x_max) const { return !(x >= x_max) && !(x_max <= yields_from_); }
  Reversal reversal(double x_max, double latched = 0) const { return reversal(x_max, top(x_max, latched)); }
  /// Source of the shape of a reversal at x_max beyond the onset: force and work of loading, columns of
  /// CurveTable.
  struct Top
  {
    double force, work, kept, span, share;
  };
  Top top(double x_max, double latched = 0) const
  {
    // beyond the onset, within the table and without an axis: all that most contacts need
    if (corrected_from_ > 1.0 && x_max > yields_from_ && x_max <= end_) [[likely]] {
      const Place p = at(x_max * per_unit_);
      const Turn& turn = turns_[p.k - first_turn_];
      const Two losses = turn.losses.both(p.t);
      return {p.loading.first(p.t), work_at(p), losses[0], losses[1], share_of(turn, p.t)};
    }
    return other_top(x_max, latched);
  }
  static Reversal reversal(double x_max, const Top& top);

  /// Work of loading to x; what complete unloading from there does not return. `lost` never falls.
  double work(double x, double latched = 0) const;
  double lost(double x, double latched = 0) const;
  /// W_u/W_L.
  double kept(double x, double latched = 0) const { return x > yields_from_ ? top(x, latched).kept : 1.0; }

  /// X that a contact first touched at dimensionless speed v latches: 0 for v <= 0 and without an axis; as at
  /// speed_end beyond it, by rate as at speed_begin below that.
  double reach(double v) const;
  /// X of every level and half-way between two, and by inertia half-way to 0: where a law is examined.
  std::vector<double> examined_levels() const;

 private:
  struct Place
  {
    const CubicPair& loading;
    double t;
    std::size_t k;
  };
  struct alignas(64) Turn
  {
    CubicPair losses;  // kept and span; of a curve with an axis -ln of both
    double share[4];
  };
  static constexpr int shift = 52 - 3;
  static_assert(CurveTable::nodes_an_octave == 1 << 3);
  std::uint64_t place(double r) const { return std::bit_cast<std::uint64_t>(r) - first_bits_; }
  bool in_table(double r) const { return place(r) < places_; }
  Place at(double r) const
  {
    const std::size_t k = place(r) >> shift;
    return {loading_[k], r - std::bit_cast<double>(std::bit_cast<std::uint64_t>(r) >> shift << shift), k};
  }
  double work_at(const Place& p) const
  {
    const Two* c = p.loading.c;
    return work_[p.k] + unit_ * p.t *
                            ((c[0][0] + p.t * (0.5 * c[1][0])) +
                             p.t * p.t * (1.0 / 3.0 * c[2][0] + p.t * (0.25 * c[3][0])));
  }
  Loading corrected(const Loading& slow, double x, double latched) const
  {
    if (!(latched > corrected_from_)) return slow;
    // F = F_slow (1 + A)
    const Axis::Force a = axis_.force(x, latched);
    return {slow.force * (1.0 + a.value), slow.stiffness * (1.0 + a.value) + slow.force * a.slope,
            slow.radius};
  }
  Loading far_loading(double x, double latched) const;
  double slow_work(double x) const;
  static double share_of(const Turn& turn, double t)
  {
    return std::min(std::max(cubic(turn.share, t), 0.0), UnloadingShape::largest_hertz_share);
  }
  Top other_top(double x_max, double latched) const;
  static Reversal reversal_with_other_span(double x_max, const Top& top);
  void add_axis();

  std::vector<CubicPair> loading_;  // force and radius of each interval, in t = (x - x_k)/unit
  std::vector<double> work_;        // of loading to each node
  std::vector<Turn> turns_;         // of the intervals from the onset on
  std::uint64_t first_bits_ = 0, places_ = 0;
  std::size_t first_turn_ = 0;
  double per_unit_ = 1, unit_ = 1, end_ = 0;
  double yields_from_ = std::numeric_limits<double>::infinity();
  double corrected_from_ = std::numeric_limits<double>::infinity();  // infinity: no axis
  Loading first_{}, last_{};                                         // at the first node, and at the end
  Axis axis_;
  CurveTable table_;
  std::optional<AxisTable> axis_table_;
};

inline Reversal Curve::reversal(double x_max, const Top& t)
{
  const double inverse = 1.0 / (t.force * x_max * t.span), mean = t.kept * t.work * inverse;
  const double n = UnloadingShape::exponent_of(mean, t.share), double_n = 2.0 * n;
  if (n < UnloadingShape::least_exponent || n > UnloadingShape::largest_exponent(t.share)) [[unlikely]]
    return reversal_with_other_span(x_max, t);
  return {
      x_max,
      t.force * inverse,
      {t.force * t.share, t.force * (5.0 - 2.0 * t.share - double_n), t.force * (t.share + double_n - 4.0)}};
}

}  // namespace granulaw
