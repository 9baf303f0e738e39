#pragma once

#include <algorithm>
#include <vector>

#include "law/cubic.hpp"
#include "law/inertia_axis.hpp"

namespace granulaw {

/// An InertiaAxis laid out for the contact loop of a particle code: the same functions, to rounding.
///
/// Linear in X, a correction is one cubic in t whose coefficients are low + weight rise: the lower slice's,
/// and what the next slice's are above them, side by side. One cache line for the loading branch, three for
/// a turn; one division.
class FastAxis
{
 public:
  FastAxis() = default;
  explicit FastAxis(const InertiaAxis& axis);

  /// A and dA/dx at overlap x of a contact that latched X > 0.
  InertiaAxis::ForceCorrection force(double x, double impact_overlap) const
  {
    const double per_x = per_spacing_ / impact_overlap;
    const Place p = locate(x * per_x, impact_overlap);
    const Coefficients c(p.cell->force, p.weight);
    return {c.value(p.t), c.slope(p.t) * per_x};
  }
  /// A, B and N of a turn at overlap x_m.
  InertiaAxis::TurnCorrection turn(double x_m, double impact_overlap) const
  {
    const Place p = locate(x_m * (per_spacing_ / impact_overlap), impact_overlap);
    return {Coefficients(p.cell->force, p.weight).value(p.t),
            Coefficients(p.cell->residual, p.weight).value(p.t),
            Coefficients(p.cell->exponent, p.weight).value(p.t)};
  }

  /// Bytes of what evaluation reads.
  std::size_t bytes() const { return cells_.size() * sizeof(Cell); }

 private:
  struct alignas(64) Function
  {
    double low[4], rise[4];
  };
  /// One interval of xi between two slices.
  struct Cell
  {
    Function force, residual, exponent;
  };
  struct Place
  {
    const Cell* cell;
    double weight, t;
  };
  struct Coefficients
  {
    double c[4];
    Coefficients(const Function& f, double weight)
    {
      for (int k = 0; k < 4; ++k) c[k] = f.low[k] + weight * f.rise[k];
    }
    double value(double t) const { return (c[0] + t * c[1]) + t * t * (c[2] + t * c[3]); }
    double slope(double t) const { return cubic_slope(c, t); }
  };

  // Without a branch: in a flow x lies within and beyond ratio_end at random. A slice's last cell stands for
  // all that lies beyond; so does the last slice, whose rise is 0.
  Place locate(double xi, double impact_overlap) const
  {
    const double row = std::min(impact_overlap * per_slice_, rows_), column = std::min(xi, columns_);
    const int k = static_cast<int>(row), l = static_cast<int>(column);
    return {cells_.data() + (k * cells_a_slice_ + l), row - k, column - l};
  }

  std::vector<Cell> cells_;  // slices 0..K, in each the L - 1 intervals of xi and the cell beyond
  double per_slice_ = 0, rows_ = 0, per_spacing_ = 0, columns_ = 0;  // K/X_end, K, (L - 1)/ratio_end, L - 1
  int cells_a_slice_ = 0;                                            // L
};

}  // namespace granulaw
