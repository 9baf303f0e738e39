#pragma once

#include "solver/shape/solid.hpp"

namespace granulaw {

/// An ellipsoid about the origin, its axes along x, y and z.
class EllipsoidSolid : public Solid
{
 public:
  explicit EllipsoidSolid(const Vector3& half_axes) : axes_(half_axes) {}

  double depth(const Vector3& x) const override;  ///< the distance itself, everywhere
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override;
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override;
  const char* kind() const override { return "ellipsoid"; }
  std::string definition() const override;

 private:
  Vector3 nearest_surface_point(const Vector3& x) const;

  Vector3 axes_;  // m, half axes
};

}  // namespace granulaw
