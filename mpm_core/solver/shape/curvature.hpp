#pragma once

#include "solver/shape/shape.hpp"

namespace granulaw {

/// Principal radii of the surface f = constant where f has this gradient, which points out of the body, and
/// this Hessian: the reciprocal eigenvalues of the Hessian over |gradient|, seen in the tangent plane.
PrincipalRadii radii_of_level_set(const Vector3& gradient, const Eigen::Matrix3d& hessian);

/// Two unit vectors that make an orthogonal frame with the unit vector `normal`: the columns.
Eigen::Matrix<double, 3, 2> tangents(const Vector3& normal);

/// Radii from the symmetric curvature matrix (1/m) in the frame of `tangents`.
PrincipalRadii radii_of_curvatures(const Eigen::Matrix2d& curvature,
                                   const Eigen::Matrix<double, 3, 2>& frame);

}  // namespace granulaw
