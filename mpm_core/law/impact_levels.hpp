#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace granulaw {

/// log2 of x > 0, exact at the powers of two and straight between them: for x = (1 + m) 2^e, 0 <= m < 1, it
/// is e + m. One conversion of x's bits.
inline double octaves(double x)
{
  return static_cast<double>(std::bit_cast<std::int64_t>(x)) * 0x1p-52 - 1023.0;
}
/// Its inverse.
inline double from_octaves(double q)
{
  return std::bit_cast<double>(static_cast<std::int64_t>((q + 1023.0) * 0x1p52));
}

/// Where the levels k = 1..K of a VelocityAxis lie in X, and the row, a level's number with its fraction, at
/// which an X lies between them.
///     from standstill  evenly, h = X_end/(K + 1 - n) apart, but for n of them that divide the first h: what
///                      inertia changes is there soon. Row 0: X = 0
///     by octaves       octaves(X_k) evenly from those of X_1 to those of X_end; an X below X_1 counts as X_1
/// An X beyond X_end counts as X_end.
class ImpactLevels
{
 public:
  ImpactLevels() = default;
  static ImpactLevels from_standstill(std::size_t levels, std::size_t within_first, double end)
  {
    return {levels, within_first, 0.0, end};
  }
  static ImpactLevels by_octaves(std::size_t levels, double first, double end)
  {
    return {levels, 1, first, end};
  }

  double row(double x) const
  {
    if (by_octaves_) return std::min(std::max((octaves(x) - origin_) * per_level_, 1.0), rows_);
    const double even = x * per_level_;
    return std::min(std::min(within_first_ * even, even + (within_first_ - 1.0)), rows_);
  }
  /// X of a row.
  double overlap(double row) const
  {
    if (row >= rows_) return end_;
    if (by_octaves_) return row <= 1.0 ? first_ : from_octaves(origin_ + row / per_level_);
    return std::max(row / within_first_, row - (within_first_ - 1.0)) / per_level_;
  }
  /// Row of the least X that is told from less: 0, or by octaves 1.
  double first_row() const { return by_octaves_ ? 1.0 : 0.0; }

 private:
  ImpactLevels(std::size_t levels, std::size_t within_first, double first, double end)
      : by_octaves_(first > 0),
        rows_(static_cast<double>(levels)),
        within_first_(static_cast<double>(within_first)),
        first_(first),
        end_(end)
  {
    per_level_ =
        by_octaves_ ? (rows_ - 1.0) / (octaves(end) - octaves(first)) : (rows_ - (within_first_ - 1.0)) / end;
    if (by_octaves_) origin_ = octaves(first) - 1.0 / per_level_;
  }

  bool by_octaves_ = false;
  double rows_ = 0, per_level_ = 0, origin_ = 0;  // K; rows an octave, or over X beyond h; octaves at row 0
  double within_first_ = 1;                       // n
  double first_ = 0, end_ = 0;                    // X_1 (by octaves), X_end
};

}  // namespace granulaw
