#pragma once

#include "solver/shape/solid.hpp"

namespace granulaw {

/// A sphere about the origin.
class SphereSolid : public Solid
{
 public:
  explicit SphereSolid(double radius) : radius_(radius) {}

  double depth(const Vector3& x) const override { return radius_ - x.norm(); }
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override { return radius_; }
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override;
  const char* kind() const override { return "sphere"; }
  std::string definition() const override;

 private:
  double radius_;  // m
};

}  // namespace granulaw
