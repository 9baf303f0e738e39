#include "solver/shape/rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace granulaw {

Eigen::Matrix3d rotation_to_plane(const Vector3& direction, double turn)
{
  int nearest = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(direction[d]) > std::abs(direction[nearest]) + 1e-12) nearest = d;
  const bool along = std::abs(direction[nearest]) > 1 - 1e-12;
  const Vector3 z = -direction, lean = Vector3::Unit(along ? (nearest + 1) % 3 : nearest);
  const Vector3 x = (lean - lean.dot(z) * z).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = x, rotation.row(1) = z.cross(x), rotation.row(2) = z;
  return Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix() * rotation;
}

double turn_along(const Vector3& direction, const Vector3& tangent)
{
  const Vector3 x = rotation_to_plane(direction) * tangent;
  return -std::atan2(x.y(), x.x());
}

}  // namespace granulaw
