#include "solver/shape/sphere_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

namespace granulaw {

Vector3 SphereSolid::outward_normal(const Vector3& x) const
{
  const double distance = x.norm();
  return distance > 0 ? Vector3(x / distance) : Vector3::UnitZ();
}

double SphereSolid::support(const Vector3& direction, Vector3* where) const
{
  if (where) *where = radius_ * direction;
  return radius_;
}

PrincipalRadii SphereSolid::principal_radii(const Vector3& direction) const
{
  return {radius_, radius_, direction.unitOrthogonal()};
}

MassProperties SphereSolid::mass_properties() const
{
  const double volume = 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
  return {volume, Vector3::Zero(), 0.4 * volume * radius_ * radius_ * Eigen::Matrix3d::Identity()};
}

std::string SphereSolid::definition() const
{
  return fmt::format("sphere {}", radius_);
}

}  // namespace granulaw
