#pragma once

#include "solver/shape/shape.hpp"

namespace granulaw {

/// Rotation from the body's frame to that of a wall with the normal +z: it turns the unit vector `direction`
/// of the body to -z. The axis of the body nearest to it leans towards +x; where it lies along an axis, the
/// next axis of the body becomes x.
Eigen::Matrix3d rotation_to_plane(const Vector3& direction, double turn = 0);
/// The turn, rad, with which the unit vector `tangent` of the body, at right angles to `direction`, becomes
/// +x.
double turn_along(const Vector3& direction, const Vector3& tangent);

}  // namespace granulaw
