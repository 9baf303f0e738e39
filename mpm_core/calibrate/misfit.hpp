#pragma once

#include <string>
#include <vector>

#include "calibrate/fit.hpp"

namespace granulaw {

/// Looks for patterns in what the fit leaves of each measurement: those of its kind (Kind::inspect), single
/// values further off than four standard deviations while the others fit, and impacts that show a stronger
/// material than slow measurements, or a weaker one.
std::vector<Misfit> name_misfits(const CalibrationProblem& problem, const Minimum& minimum);

/// A pattern counts from so many standard deviations on: of those stated, or of the scatter about the pattern
/// where that is more; and of the scatter where that is less: of eight values it is itself known to a third,
/// and Student's t has 0.4 % beyond.
inline constexpr double clear_by_stated = 3, clear_by_scatter = 5;

/// Relative differences of some values from the fit, over a coordinate from -1 to 1.
struct Differences
{
  std::vector<double> place, relative, sd;
};
/// Weighted least squares of the first three Legendre polynomials: factor and its sd.
struct Factors
{
  double value[3], sd[3];
  double scatter;  ///< of what they leave, over the sd given
  /// True: a factor is no chance and no error of the model, whose sd is `model`.
  bool seen(int k, double model) const;
};
Factors legendre_factors(const Differences& differences);
/// Standard deviations by which there are too few runs of one sign (Wald and Wolfowitz 1940).
double missing_runs(const std::vector<double>& values);

/// A measurement against the fit, as its kind looks at it.
class Inspection
{
 public:
  Inspection(const CalibrationProblem& problem, const Minimum& minimum, std::size_t index);

  const Measurement& measurement;
  const CalibrationProblem::Comparison comparison;
  std::vector<Misfit> found;

  void say(const char* name, const std::string& sentence)
  {
    found.push_back({measurement.source, name, sentence});
  }
  /// Adds a datum's difference from the fit.
  void add_to(Differences& differences, std::size_t datum, double place) const;
  /// Sd of each of the (up to three) factors that the model's own error may have: the kind's, that of a law
  /// by runs and of a composed one; of e, absolute, of other values relative.
  double model_error() const;
  /// The model's own errors as fitted, over their sd.
  std::vector<double> model_errors() const;
  /// Standard deviations by which the values that depend on the strength lie above the fit.
  double above() const;
  void look_for_outliers();

 private:
  const CalibrationProblem& problem_;
  const Minimum& minimum_;
  std::size_t index_;
};

}  // namespace granulaw
