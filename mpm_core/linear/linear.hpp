#pragma once

#include <Eigen/Core>

namespace granulaw {

// Decompositions of Eigen, compiled once: each costs the compiler 6 s, in every unit that has it.

/// The x that minimises |a x - b|: QR with pivots.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Eigenvalues of a symmetric matrix in rising order, and their unit vectors: the columns.
struct PlaneModes
{
  Eigen::Vector2d values;
  Eigen::Matrix2d vectors;
};
PlaneModes symmetric_modes(const Eigen::Matrix2d& symmetric);

}  // namespace granulaw
