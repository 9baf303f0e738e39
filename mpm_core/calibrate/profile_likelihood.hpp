#pragma once

#include "calibrate/calibrate.hpp"

namespace granulaw {

/// The interval in which, with all other unknowns fitted anew at each place, the sum of squares stays within
/// what 68 or 95 % of a chi^2 of one degree of freedom do (Venzon and Moolgavkar, Appl. Statist. 37, 1988),
/// widened.
ParameterProfile profile_likelihood(const CalibrationProblem& problem, const Minimum& minimum,
                                    std::size_t unknown, const Widening& widening);

}  // namespace granulaw
