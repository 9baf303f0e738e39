#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "contact/cubic.hpp"
#include "law/impact_levels.hpp"
#include "contact/unloading.hpp"

namespace granulaw {

/// What the speed of an impact does to a contact law: smooth corrections of a ContactCurve.
///
/// Why this form. The mass of the yielding zone has to be set moving and brought to rest: an impact's force
/// exceeds a slow press's at the same overlap early in the contact (+10 to +50 % at a tenth of its largest
/// overlap), crosses it at about two thirds and ends below it (-2 % at I = rho V^2/Y = 0.01, -7 % at 0.06).
/// Over the ratio xi = x/X, X the overlap at which a free sphere thrown at the rigid wall at that speed
/// reverses, this is one shape that grows with X and vanishes for xi well beyond 1, whatever the driving.
///
/// State. X is latched once, at first touch, from the normal approach speed, and forgotten when the overlap
/// ends; so every contact obeys a one-dimensional law, and the energy argument of ContactCurve holds for each
/// X. X = 0 is the quasi-static law.
///
/// Speed coordinate, V the relative normal speed of the pair at first touch, PairMapping's lambda and R*:
///     inertia   v = V sqrt(m_1/(4/3 pi R_1^3 c Y_s)), that is v^2 = I = rho V^2/Y of the one body that moves
///               like the pair: radius R_1 = lambda R*, mass m_1 = lambda m*; c the body's mass_ratio. On a
///               rigid wall this is rho_s V^2/Y_s; a like pair's spheres each see a wall at V/2
///     rate      v = V R_ref/(lambda R*) sqrt(rho_s/Y_s): the strain rate goes as V/(lambda R*); at the
///               reference radius on a rigid wall the same number as above
///
/// What is stored.
///     impact_overlap[j]   X and dX/dv at nodes uniform in v from 0 to speed_end; X[0] = 0. Cubic Hermite.
///                         Beyond speed_end X is clamped: the caller compares with speed_end() and counts.
///     corrections         K levels, each at L nodes uniform in xi from 0 to ratio_end, value and d/dxi,
///                         impact level after level. X_end = X(speed_end);
///                         inertia: n = first_levels of them divide the first h evenly, the others follow at
///                         2 h, 3 h, ..., X_end: h = X_end/(K + 1 - n); no correction at X = 0 (level 0, not
///                         stored)
///                         rate: from X_1 = X(speed_begin) to X_K = X_end evenly in octaves() of
///                         ImpactLevels, since the flow stress goes with the logarithm of the rate, or
///                         slower. No impact is slower than speed_begin: X is clamped there, too, and the
///                         caller compares with speed_begin() and counts
///         force_correction A      F_L = F_qs(x) (1 + A)
///         residual_correction B   residual ratio = rho_qs(x_m) + B, kept within 0 to 0.999995
///         exponent_correction N   n = n_qs(x_m) + N, kept where the unloading rises
/// Cubic Hermite in xi, so that the stiffness is continuous; linear in X, or in octaves(X), in which nothing
/// is ever derived. Beyond ratio_end: A = 0 (its last value and slope are), B and N keep their last values.
/// The contact radius is not corrected.
class VelocityAxis
{
 public:
  enum class Kind { inertia, rate };

  /// An X up to here corrects nothing that a double could hold; X and what is divided by it stay normal.
  static constexpr double negligible = 1e-100;

  /// As stored in a file. Correction vectors have levels * L entries, L at least 2.
  struct Table
  {
    Kind kind = Kind::inertia;
    double reference_radius = 0;                                   ///< m; kind rate only, else 0
    double speed_begin = 0;                                        ///< v of level 1; kind rate only, else 0
    double speed_end = 0;                                          ///< v at the last node
    std::vector<double> impact_overlap, impact_overlap_slope;      ///< X and dX/dv
    std::size_t levels = 0;                                        ///< K
    std::size_t first_levels = 1;                                  ///< n; kind inertia only, else 1
    double ratio_end = 0;                                          ///< xi at the last node
    std::vector<double> force_correction, force_correction_slope;  ///< value and d/dxi
    std::vector<double> residual_correction, residual_correction_slope;
    std::vector<double> exponent_correction, exponent_correction_slope;

    std::size_t ratio_nodes() const { return levels ? force_correction.size() / levels : 0; }
  };

  /// Throws Error naming `where` if a length, a value at a node or a cubic between nodes is out of range, if
  /// X(v) falls, or if A does not end at 0 with slope 0. What the corrections make of a curve is checked by
  /// ContactCurve.
  VelocityAxis(const Table& table, const std::string& where);

  const Table& table() const { return table_; }
  Kind kind() const { return table_.kind; }
  double speed_begin() const { return table_.speed_begin; }
  double speed_end() const { return table_.speed_end; }
  /// X_end, the largest X.
  double overlap_end() const { return overlap_end_; }
  /// X that a contact first touched at dimensionless speed v latches: 0 for v <= 0, X_end beyond speed_end,
  /// kind rate: X_1 below speed_begin.
  double impact_overlap(double v) const;
  /// Where the levels lie in X.
  const ImpactLevels& scale() const { return scale_; }
  /// X of every level and half-way between two (and half-way to X = 0, kind inertia): where a law is
  /// examined.
  std::vector<double> examined_overlaps() const;

  /// A and dA/dx at overlap x of a contact that latched X > 0.
  struct ForceCorrection
  {
    double value, slope;
  };
  ForceCorrection force(double x, double impact_overlap) const
  {
    const Place p = locate(x, impact_overlap);
    return {blend(p, p.low->force, p.high->force),
            blend_slope(p, p.low->force, p.high->force) * per_spacing_ / impact_overlap};
  }

  /// A, B and N of a reversal at overlap x_m.
  struct ReversalCorrection
  {
    double force, residual, exponent;
    static constexpr double largest_ratio = 0.999995;
    double corrected_residual(double ratio) const { return std::clamp(ratio + residual, 0.0, largest_ratio); }
    /// The same for span = 1 - ratio.
    double corrected_span(double span) const
    {
      return std::min(std::max(span - residual, 1.0 - largest_ratio), 1.0);
    }
    UnloadingShape corrected_shape(UnloadingShape s) const
    {
      const double most = UnloadingShape::largest_exponent(s.hertz_share);
      return {std::min(std::max(s.exponent + exponent, UnloadingShape::least_exponent), most), s.hertz_share};
    }
  };
  ReversalCorrection reversal(double x_m, double impact_overlap) const
  {
    const Place p = locate(x_m, impact_overlap);
    return {blend(p, p.low->force, p.high->force), blend(p, p.low->residual, p.high->residual),
            blend(p, p.low->exponent, p.high->exponent)};
  }

  /// Bytes of what evaluation reads.
  std::size_t bytes() const { return cells_.size() * sizeof(Cell); }

 private:
  /// Cubic coefficients in t over one interval of xi in one level.
  struct alignas(32) Cell
  {
    double force[4], residual[4], exponent[4];
  };
  struct Place
  {
    const Cell *low, *high;  // of the levels below and above X
    double weight, t;
  };

  void place_levels(const std::string& where);
  void lay_out_cells(const std::string& where);

  // Without a branch: in a flow x lies within and beyond ratio_end at random. A level's last cell stands for
  // all that lies beyond, and of no number.
  Place locate(double x, double impact_overlap) const
  {
    const double row = scale_.row(impact_overlap);
    const double column = std::min(columns_, x / impact_overlap * per_spacing_);
    const int k = std::min(static_cast<int>(row), last_row_), l = static_cast<int>(column);
    const Cell* const low = cells_.data() + k * cells_a_level_ + l;
    return {low, low + cells_a_level_, row - k, column - l};
  }
  static double blend(const Place& p, const double (&low)[4], const double (&high)[4])
  {
    const double value = cubic(low, p.t);
    return value + p.weight * (cubic(high, p.t) - value);
  }
  static double blend_slope(const Place& p, const double (&low)[4], const double (&high)[4])
  {
    const double value = cubic_slope(low, p.t);
    return value + p.weight * (cubic_slope(high, p.t) - value);
  }

  std::vector<Cell> cells_;  // levels 0..K, in each the L - 1 intervals of xi and the cell beyond
  ImpactLevels scale_;
  double per_spacing_ = 0, columns_ = 0;  // (L - 1)/ratio_end, L - 1
  int last_row_ = 0, cells_a_level_ = 0;  // K - 1, L
  double overlap_end_ = 0;
  Table table_;
};

}  // namespace granulaw
