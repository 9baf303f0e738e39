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

/// Where the slices k = 1..K of an InertiaAxis lie in X, and the row, a slice's number with its fraction, at
/// which an X lies between them.
///     even        X_k = k X_end/K; row 0: X = 0
///     by octaves  octaves(X_k) evenly from those of X_1 to those of X_end; an X below X_1 counts as X_1
/// An X beyond X_end counts as X_end.
class SliceScale
{
 public:
  SliceScale() = default;
  static SliceScale even(std::size_t slices, double end) { return {slices, 0.0, end}; }
  static SliceScale by_octaves(std::size_t slices, double first, double end) { return {slices, first, end}; }

  double row(double x) const
  {
    const double at = by_octaves_ ? std::max(1.0, (octaves(x) - origin_) * per_slice_) : x * per_slice_;
    return std::min(at, rows_);
  }
  /// X of a row.
  double overlap(double row) const
  {
    if (row >= rows_) return end_;
    if (!by_octaves_) return end_ * row / rows_;
    return row <= 1.0 ? first_ : from_octaves(origin_ + row / per_slice_);
  }
  /// Row of the least X that is told from less: 0, or by octaves 1.
  double first_row() const { return by_octaves_ ? 1.0 : 0.0; }

 private:
  SliceScale(std::size_t slices, double first, double end)
      : by_octaves_(first > 0), rows_(static_cast<double>(slices)), first_(first), end_(end)
  {
    per_slice_ = by_octaves_ ? (rows_ - 1.0) / (octaves(end) - octaves(first)) : rows_ / end;
    if (by_octaves_) origin_ = octaves(first) - 1.0 / per_slice_;
  }

  bool by_octaves_ = false;
  double rows_ = 0, per_slice_ = 0, origin_ = 0;  // K; rows an octave, or over X; octaves at row 0
  double first_ = 0, end_ = 0;                    // X_1 (by octaves), X_end
};

}  // namespace granulaw
