#include "linear/linear.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace granulaw {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b)
{
  return a.colPivHouseholderQr().solve(b);
}

PlaneModes symmetric_modes(const Eigen::Matrix2d& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(symmetric);
  return {modes.eigenvalues(), modes.eigenvectors()};
}

}  // namespace granulaw
