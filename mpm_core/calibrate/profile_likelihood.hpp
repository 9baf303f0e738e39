#pragma once

#include <optional>

#include "calibrate/fit.hpp"

namespace granulaw {

/// What the data say of one parameter, SI. An end that no data tell is the end of what is allowed.
struct Interval
{
  double low = 0, high = 0;
  bool low_told = true, high_told = true;
};
struct ParameterProfile
{
  double value = 0;
  Interval within68, within95;
  Coordinates low95, high95;  ///< all unknowns at the ends of the 95 % interval
  std::optional<Coordinates>
      better;  ///< a place with a smaller sum of squares than the minimum's, if one was met
};

/// The interval in which, with all other unknowns fitted anew at each place, the sum of squares stays within
/// what 68 or 95 % of a chi^2 of one degree of freedom do (Venzon and Moolgavkar, Appl. Statist. 37, 1988),
/// times `scale`.
ParameterProfile profile_likelihood(const CalibrationProblem& problem, const Minimum& minimum,
                                    std::size_t unknown, double scale);

}  // namespace granulaw
