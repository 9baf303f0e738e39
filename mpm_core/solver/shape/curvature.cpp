#include "solver/shape/curvature.hpp"

#include <Eigen/Geometry>
#include <limits>

#include "linear/linear.hpp"

namespace granulaw {

Eigen::Matrix<double, 3, 2> tangents(const Vector3& normal)
{
  Eigen::Matrix<double, 3, 2> frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  return frame;
}

PrincipalRadii radii_of_curvatures(const Eigen::Matrix2d& curvature, const Eigen::Matrix<double, 3, 2>& frame)
{
  const PlaneModes principal = symmetric_modes(curvature);
  const auto radius = [&](int k) {
    const double value = principal.values[k];
    return value == 0 ? std::numeric_limits<double>::infinity() : 1 / value;
  };
  return {radius(1), radius(0), frame * principal.vectors.col(1)};
}

PrincipalRadii radii_of_level_set(const Vector3& gradient, const Eigen::Matrix3d& hessian)
{
  const double slope = gradient.norm();
  const Eigen::Matrix<double, 3, 2> frame = tangents(gradient / slope);
  return radii_of_curvatures(frame.transpose() * hessian * frame / slope, frame);
}

}  // namespace granulaw
