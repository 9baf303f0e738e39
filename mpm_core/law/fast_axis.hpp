#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "contact/cubic.hpp"
#include "law/velocity_axis.hpp"

namespace granulaw {

/// A VelocityAxis laid out for the contact loop of a particle code: the same functions, to rounding.
///
/// Linear in X (or octaves of X), a correction is one cubic in t whose coefficients are low + weight rise:
/// the lower slice's, and what the next slice's are above them, side by side. One cache line for the loading
/// branch, three for a reversal; one division.
class FastAxis
{
 public:
  FastAxis() = default;
  explicit FastAxis(const VelocityAxis& axis);

  /// A and dA/dx at overlap x of a contact that latched X > 0.
  VelocityAxis::ForceCorrection force(double x, double impact_overlap) const
  {
    const double per_x = per_spacing_ / impact_overlap;
    const Place p = locate(x * per_x, impact_overlap);
    const Two value = p.cell->force.both(p.t), slope = p.cell->force.slope_of_both(p.t);
    return {value[0] + p.weight * value[1], (slope[0] + p.weight * slope[1]) * per_x};
  }
  /// A, B and N of a reversal at overlap x_m.
  VelocityAxis::ReversalCorrection reversal(double x_m, double impact_overlap) const
  {
    const Place p = locate(x_m * (per_spacing_ / impact_overlap), impact_overlap);
    const Two force = p.cell->force.both(p.t);
    const Two rest = p.cell->low.both(p.t) + p.weight * p.cell->rise.both(p.t);
    return {force[0] + p.weight * force[1], rest[0], rest[1]};
  }

  /// Bytes of what evaluation reads.
  std::size_t bytes() const { return cells_.size() * sizeof(Cell); }

 private:
  /// One interval of xi between two levels.
  struct Cell
  {
    CubicPair force;      // of the lower level, and its rise
    CubicPair low, rise;  // of residual and exponent
  };
  struct Place
  {
    const Cell* cell;
    double weight, t;
  };
  // Without a branch: in a flow x lies within and beyond ratio_end at random. A slice's last cell stands for
  // all that lies beyond; so does the last level, whose rise is 0.
  // The column is rounded to the nearest cell's middle by adding 1.5 2^52, whose last bits then count cells:
  // two additions in place of two conversions in the longest chain of a reversal. A whole number may fall to
  // the cell that ends there. Of no number it is the last column: a cell that exists.
  Place locate(double cells, double impact_overlap) const
  {
    constexpr double counter = 0x1.8p52;
    const double row = scale_.row(impact_overlap), column = std::min(columns_, cells);
    const double counted = (column - 0.5) + counter;
    const int k = static_cast<int>(row), l = static_cast<int>(std::bit_cast<std::uint64_t>(counted));
    return {cells_.data() + (k * cells_a_level_ + l), row - k, column - (counted - counter)};
  }

  std::vector<Cell> cells_;  // levels 0..K, in each the L - 1 intervals of xi and the cell beyond
  ImpactLevels scale_;
  double per_spacing_ = 0, columns_ = 0;  // (L - 1)/ratio_end, L - 1
  int cells_a_level_ = 0;                 // L
};

}  // namespace granulaw
