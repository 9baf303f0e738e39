#pragma once

#include "calibrate/calibrate.hpp"

namespace granulaw {

/// Least squares by MINPACK's Levenberg-Marquardt steps in a trust region (Eigen's port of lmder) from `start`; the
/// unknowns for which `fixed` is true stay there.
Minimum minimise(const CalibrationProblem& problem, const Coordinates& start, const std::vector<bool>& fixed,
                 int most_steps = 60);

/// The least of the minima from problem.starts().
Minimum best_fit(const CalibrationProblem& problem);

/// From `start` to the minimum, begun anew until nothing is gained.
Minimum polished(const CalibrationProblem& problem, const Coordinates& start);

/// Derivatives of the residuals by all unknowns.
Eigen::MatrixXd jacobian_at(const CalibrationProblem& problem, const Coordinates& q);

/// Covariance of the unknowns by the Jacobian; directions that no residual determines have a variance of 1e6.
Eigen::MatrixXd covariance(const Minimum& minimum);

}  // namespace granulaw
