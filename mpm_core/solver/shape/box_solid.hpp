#pragma once

#include "solver/shape/solid.hpp"

namespace granulaw {

/// A box about the origin, its sides along x, y and z, with rounded edges and corners: all points within
/// `edge_radius` of a box that is smaller by that on every side.
class BoxSolid : public Solid
{
 public:
  BoxSolid(const Vector3& sides, double edge_radius)
      : inner_(0.5 * sides - Vector3::Constant(edge_radius)), edge_radius_(edge_radius)
  {
  }

  double depth(const Vector3& x) const override;  ///< the distance itself, everywhere
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override { return edge_radius_; }
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override;
  const char* kind() const override { return "box"; }
  std::string definition() const override;

 private:
  Vector3 inner_;  // m, half sides without the rounding
  double edge_radius_;
};

}  // namespace granulaw
