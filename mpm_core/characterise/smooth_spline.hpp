#pragma once

#include <span>
#include <vector>

namespace granulaw {

/// A cubic spline on [0, q_end] with y(0) = y'(0) = 0, fitted by weighted, penalised least squares.
///
/// Why these end conditions: everything that plasticity adds to the elastic law starts at the onset of yield
/// (q = 0) with zero value and zero slope.
class SmoothSpline
{
 public:
  struct Sample
  {
    double q, value, weight;
  };

  SmoothSpline() = default;
  /// `intervals` equal knot intervals. The penalty on the third differences of the coefficients is
  /// `stiffness` times the mean weight of the data: it bridges knots without data and cannot follow grid
  /// noise. At least 2 samples are needed.
  SmoothSpline(double q_end, int intervals, std::span<const Sample> samples, double stiffness);

  /// Value and derivative; beyond [0, q_end] the last cubic goes on, below 0 both are 0.
  double value(double q) const { return evaluate(q).value; }
  double slope(double q) const { return evaluate(q).slope; }

 private:
  struct Point
  {
    double value, slope;
  };
  Point evaluate(double q) const;

  std::vector<double> coefficients_;
  double spacing_ = 1;
};

}  // namespace granulaw
