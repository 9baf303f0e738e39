#pragma once

#include <string>
#include <vector>

#include "calibrate/fit.hpp"

namespace granulaw {

/// A systematic difference between data and fit that has a name.
struct Misfit
{
  std::string source;    ///< the measurement's; empty: between several
  std::string name;      ///< in one or two words
  std::string sentence;  ///< what it is, and what it may come from
};

/// Looks at what the fit leaves of each measurement.
/// - Trend and bend: factors of Legendre polynomials over the logarithm of speed or force, which count where
/// neither the
///   scatter nor the model's error explains them.
/// - e below 1 where the fitted material does not yield.
/// - A loading force that falls: fracture.
/// - Values further off than four standard deviations while the others fit.
/// - Impacts that show a stronger material than slow measurements, or a weaker one.
/// - A curve that takes more of the model's own error than three of its standard deviations.
/// - Runs of one sign longer than chance (Wald and Wolfowitz 1940).
std::vector<Misfit> name_misfits(const CalibrationProblem& problem, const Minimum& minimum);

}  // namespace granulaw
