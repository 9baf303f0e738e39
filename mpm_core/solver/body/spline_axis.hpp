#pragma once

#include <array>
#include <vector>

namespace granulaw {

/// Quadratic B-splines over the lines of one axis of a Cartesian grid, spaced as one likes. Open at both
/// ends: the first and the last function are 1 there. With n cells there are n + 2 functions; function i
/// "sits" at node(i), the Greville abscissa, so that sums of node coordinates reproduce every linear field
/// exactly (de Boor, A Practical Guide to Splines, chapter 9).
class SplineAxis
{
 public:
  SplineAxis() = default;
  /// `lines`: ascending, at least 2.
  explicit SplineAxis(std::vector<double> lines);

  struct Values
  {
    int first;                      ///< index of the first of the three functions that are not zero
    std::array<double, 3> n, dn{};  ///< values and slopes
  };
  /// At x, clamped to the range of the lines.
  Values at(double x) const;

  int cells() const { return static_cast<int>(lines_.size()) - 1; }
  int functions() const { return cells() + 2; }
  const std::vector<double>& lines() const { return lines_; }
  double node(int function) const { return nodes_[static_cast<std::size_t>(function)]; }
  /// Index of the cell that holds x (clamped).
  int cell(double x) const;

 private:
  std::vector<double> lines_, nodes_;
  std::vector<int> lookup_;  // equal buckets -> first cell that overlaps them
  double per_bucket_ = 0;
};

/// Lines of a graded axis: equal steps `fine` over [from, until], then steps that grow by the factor `growth`
/// up to `coarsest`, until `end` is reached (the last steps are scaled to fit). `shift` takes that part
/// off the first step, so that all lines but the first move.
std::vector<double> graded_lines(double from, double until, double end, double fine, double growth,
                                 double coarsest, double shift = 0);

}  // namespace granulaw
