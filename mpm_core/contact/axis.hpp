#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/cubic.hpp"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(__ASSOCIATIVE_MATH__)
#error "granulaw's contact laws need IEEE arithmetic: compile without -ffast-math (-Ofast, -fassociative-math, -ffinite-math-only)"
#endif

namespace granulaw {

/// Changes of a CurveTable by the speed of an impact.
///
/// The mass of the yielding zone has to be set moving and brought to rest: the force of an impact exceeds a
/// slow press's at the same overlap early in the contact (+10 to +50 % at a tenth of its largest overlap),
/// crosses it at about two thirds and ends below it (-2 % at I = rho V^2/Y = 0.01, -7 % at 0.06). Over x/X,
/// X the overlap at which a free sphere thrown at the rigid wall at that speed reverses, this is one shape
/// that grows with X and vanishes well beyond 1.
///
/// X is latched once, at first touch, from the normal approach speed, and reset when the overlap ends: every
/// contact obeys a one-dimensional law. X = 0 is the slow press.
///
/// Speed coordinate, V the relative normal speed of the pair at first touch, PairMapping's lambda and R*:
///     inertia   v = V sqrt(m_1/(4/3 pi R_1^3 c Y_s)), that is v^2 = I = rho V^2/Y of the one body that moves
///               like the pair: radius R_1 = lambda R*, mass m_1 = lambda m*; c the body's mass_ratio
///     rate      v = V R_ref/(lambda R*) sqrt(rho_s/Y_s): the strain rate goes as V/(lambda R*); at the
///               reference radius on a rigid wall the same number as above
struct AxisTable
{
  enum class By { inertia, rate };

  By by = By::inertia;
  double reference_radius = 0;  ///< m; by rate only, else 0
  double speed_begin = 0;       ///< v of the first level, the slowest impact stored; by rate only, else 0
  double speed_end = 0;         ///< v at the last node of `reach`; faster impacts count as this one
  HermiteColumn reach;          ///< X(v) at nodes even in v from 0; slopes by v
  std::vector<double> level;    ///< X_k, ascending; between levels all is linear in X, below the first one to
                                ///< nothing at X = 0 (by rate: as at the first)
  std::vector<double> kept, span;  ///< CurveTable's, of an impact that reverses at its X_k
  double share_end = 0;            ///< x/X at the last node of `force`
  HermiteColumn force;  ///< A at nodes even in x/X from 0, level after level; slopes by x/X. F = F_slow (1 +
                        ///< A); from share_end on F = F_slow

  std::size_t shares() const { return level.empty() ? 0 : force.size() / level.size(); }
  double share_spacing() const { return share_end / static_cast<double>(shares() - 1); }
};

/// An AxisTable laid out for the contact loop.
class Axis
{
 public:
  /// An X up to here changes nothing that a double could hold; X and what is divided by it stay normal.
  static constexpr double negligible = 1e-100;
  /// Levels are at least this factor apart, and at most so many.
  static constexpr double least_gap = 1.008;
  static constexpr std::size_t most_levels = 255;

  Axis() = default;
  /// `mean` of the curve's work of loading: W = W_slow (1 + M) at the nodes of `table.force`. `kept`, `span`:
  /// by how much -ln of both exceeds the slow press's at each level.
  Axis(const AxisTable& table, const HermiteColumn& mean, const std::vector<double>& kept,
       const std::vector<double>& span);

  /// A and dA/dx at overlap x of a contact that latched X > 0.
  struct Force
  {
    double value, slope;
  };
  Force force(double x, double latched) const
  {
    const double per_x = per_spacing_ / latched;
    const Place p = locate(x * per_x, row(latched));
    const Two value = p.cell->force.both(p.t), slope = p.cell->force.slope_of_both(p.t);
    return {value[0] + p.weight * value[1], (slope[0] + p.weight * slope[1]) * per_x};
  }

  /// All that a reversal at x takes. `mean` holds up to share_end X; beyond, the extra work stays what it was
  /// there.
  struct Effect
  {
    double force, mean;
    Two losses;  ///< -ln kept, -ln span beyond the slow press's, of an impact to X
  };
  Effect effect(double x, double latched) const
  {
    const Row r = row(latched);
    const Place p = locate(x * (per_spacing_ / latched), r);
    const Two force = p.cell->force.both(p.t), mean = p.cell->mean.both(p.t);
    const Level& low = levels_[r.index];
    return {force[0] + p.weight * force[1], mean[0] + p.weight * mean[1], low.losses + r.weight * low.rise};
  }
  double share_end() const { return share_end_; }
  std::size_t bytes() const
  {
    return cells_.size() * sizeof(Cell) + levels_.size() * sizeof(Level) + rows_.size();
  }

 private:
  /// One interval of x/X between two levels: of the lower level, and how much more the upper has.
  struct Cell
  {
    CubicPair force, mean;
  };
  struct alignas(64) Level
  {
    Two losses{}, rise{};
    double x = 0, next = std::numeric_limits<double>::infinity(), per_gap = 0;
  };
  struct Row
  {
    std::size_t index;
    double weight;
  };
  struct Place
  {
    const Cell* cell;
    double weight, t;
  };

  /// The bits of X give the interval in which at most one level lies. Of no number: the last level.
  Row row(double latched) const
  {
    const double x = std::min(end_, latched);
    const std::uint64_t bin = (std::bit_cast<std::uint64_t>(x) >> shift) - first_bin_;
    std::size_t k = bin < rows_.size() ? rows_[bin] : 0;
    k += x >= levels_[k].next;
    return {k, (x - levels_[k].x) * levels_[k].per_gap};
  }
  // Without a branch: in a flow x lies within and beyond share_end at random. A level's last cell stands for
  // all that lies beyond. The column is rounded to the nearest cell's middle by adding 1.5 2^52, whose last
  // bits then count cells: two additions in place of two conversions in the longest chain of a reversal. A
  // whole number may fall to the cell that ends there. Of no number it is the last column: a cell that
  // exists.
  Place locate(double cells, const Row& r) const
  {
    constexpr double counter = 0x1.8p52;
    const double column = std::min(columns_, cells), counted = (column - 0.5) + counter;
    const int l = static_cast<int>(std::bit_cast<std::uint64_t>(counted));
    return {cells_.data() + (static_cast<int>(r.index) * cells_a_level_ + l), r.weight,
            column - (counted - counter)};
  }

  static constexpr int shift = 52 - 7;  // 128 intervals an octave: each below least_gap wide

  std::vector<Cell> cells_;         // levels 0..K, in each the L - 1 intervals of x/X and the cell beyond
  std::vector<Level> levels_;       // 0..K; level 0: X = 0
  std::vector<std::uint8_t> rows_;  // level at or below the beginning of each interval of X
  std::uint64_t first_bin_ = 0;
  double end_ = 0, share_end_ = 0;
  double per_spacing_ = 0, columns_ = 0;  // (L - 1)/share_end, L - 1
  int cells_a_level_ = 0;                 // L
};

}  // namespace granulaw
