#pragma once

#include <vector>

namespace granulaw {

/// One function of a LawShape between its nodes, in q = ln(s/s_onset): the cubic spline through them, which
/// leaves the onset with zero slope.
class ShapeFunction
{
 public:
  enum class Kind {
    any,
    rising,  ///< never falls: nodes below an earlier one are raised to it, slopes limited where it would
             ///< swing
  };

  ShapeFunction(std::vector<double> values, double q_end, Kind kind = Kind::any);
  /// Beyond its end, where the last node of a table may lie, it goes on straight.
  double value(double q) const;
  double slope(double q) const;

 private:
  static std::vector<double> raised(std::vector<double> values);
  double end_slope() const;
  void limit_slopes();
  double at(double q, bool slope) const;

  std::vector<double> values_, slopes_;
  double spacing_, q_end_;
};

}  // namespace granulaw
