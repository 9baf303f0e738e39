#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "law/contact_curve.hpp"
#include "law/fast_pow.hpp"

namespace granulaw::plugin {

/// A ContactCurve re-tabulated for the contact loop of a particle code: force and dissipated work only, no
/// square root on the way to the interval.
///
/// Nodes divide each octave of x = overlap/(lambda R*) into 8 equal parts from 2^-40 up to x_end, so that the
/// bits of x give the interval and the position in it. In each interval four cubics in that position, each
/// exact at four equidistant points of the curve:
///     force     F_L(x)                    residual  delta_r/delta_m
///     exponent  n                         work      W_load - W_unload: spent on plastic strain
/// in the curve's units (Hertz force at x = 1). One cache line for the loading branch, two for unloading.
/// Below 2^-40 and beyond x_end the curve itself answers. Error against the curve:
/// tests/liggghts/hot_table_test.cpp.
class HotTable
{
 public:
  HotTable() = default;
  explicit HotTable(const ContactCurve& curve);

  /// Force at overlap x of a contact whose largest overlap so far is x_max; ratio = x/x_max.
  double force(double x, double x_max, double ratio) const
  {
    if (x >= x_max || x_max <= onset_) return in_table(x) ? at(x).force() : curve_->loading(x).force;
    if (!in_table(x_max)) [[unlikely]]
      return slow_unloading(x_max, ratio);
    const Place place = at(x_max);
    const double residual = place.residual(), u = (ratio - residual) / (1.0 - residual);
    return u <= 0.0 ? 0.0 : place.force() * fast_pow(u, place.exponent());
  }

  /// Work spent on plastic strain by a contact whose largest overlap is x_max: a function of x_max alone,
  /// because unloading and reloading share a curve.
  double dissipated(double x_max) const
  {
    if (x_max <= onset_) return 0.0;
    return in_table(x_max) ? at(x_max).work() : curve_->work_loading(x_max) - curve_->work_unloading(x_max);
  }

  const ContactCurve& curve() const { return *curve_; }

 private:
  static constexpr int bits_per_octave = 3, lowest_exponent = -40;
  static constexpr int shift = 52 - bits_per_octave;
  struct alignas(64) Interval
  {
    double force[4], residual[4], exponent[4], work[4];
  };

  struct Place
  {
    const Interval& i;
    double t;
    double cubic(const double (&c)[4]) const { return (c[0] + t * c[1]) + t * t * (c[2] + t * c[3]); }
    double force() const { return cubic(i.force); }
    double residual() const { return cubic(i.residual); }
    double exponent() const { return cubic(i.exponent); }
    double work() const { return cubic(i.work); }
  };

  static constexpr std::uint64_t first_bits = static_cast<std::uint64_t>(1023 + lowest_exponent) << 52;

  bool in_table(double x) const { return x >= lowest_ && x <= x_end_; }
  Place at(double x) const
  {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t position = (bits << bits_per_octave & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL;
    return {intervals_[(bits - first_bits) >> shift], std::bit_cast<double>(position) - 1.0};
  }
  double slow_unloading(double x_max, double ratio) const;

  std::vector<Interval> intervals_;
  const ContactCurve* curve_ = nullptr;  // of the law in memory, which outlives this
  double lowest_ = 0, x_end_ = 0, onset_ = 0;
};

}  // namespace granulaw::plugin
