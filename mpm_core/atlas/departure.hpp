#pragma once

#include <array>
#include <vector>

#include "law/law_shape.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// Difference between a law and its guide, a law that needs no run: by overlap/onset, in which it is small, smooth
/// and hardly depends on the stiffness. So few runs show it, and spheres of other stiffness share it.
///
/// Each of LawShape::functions is a cubic spline by (x/onset)^(1/4) in up to 24 intervals that
/// leaves the onset with zero value and slope, by penalised least squares on second differences. Knots even in
/// ln x, or a penalty on third differences, swing between the onset and the first run. Beyond the last point it
/// keeps its value.
class Departure
{
 public:
  /// One difference: ln or value as LawShape has it, of the law less the guide.
  struct Point
  {
    double over_onset, value;  ///< overlap/onset, over 1
    double weight = 1;
  };
  using Points = std::array<std::vector<Point>, LawShape::function_count>;  ///< in the order of LawShape::functions

  /// One function. With a single point it is proportional to the square of the coordinate, with none 0.
  class Function
  {
   public:
    Function() = default;
    explicit Function(const std::vector<Point>& points);
    double at(double over_onset) const;

   private:
    Spline spline_;
    double end_ = 0;  // by the coordinate
  };

  /// None: 0.
  Departure() = default;
  explicit Departure(const Points& points);
  /// Departure of a quasi-static law from its guide, up to where one of them ends.
  static Departure between(const Curve& own, const LawShape& guide);

  /// Adds it to a master at the same overlap/onset; velocity effects stay.
  void add_to(LawShape& master) const;
  double at(std::size_t function, double over_onset) const { return functions_[function].at(over_onset); }
  /// Overlap/onset of the last point; 0 of none.
  double end() const { return end_; }

 private:
  std::array<Function, LawShape::function_count> functions_;
  double end_ = 0;
};

}  // namespace granulaw
