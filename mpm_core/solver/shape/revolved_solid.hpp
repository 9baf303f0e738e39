#pragma once

#include "solver/shape/profile.hpp"
#include "solver/shape/solid.hpp"

namespace granulaw {

/// The body of revolution of a meridian curve about the z axis, with the middle of its height in the origin:
/// its contact pole is (0, 0, -height/2). Polyline as it is: smooth shapes are sampled finely (shapes.hpp).
class RevolvedSolid : public Solid
{
 public:
  explicit RevolvedSolid(Profile profile);

  double depth(const Vector3& x) const override;  ///< the distance itself, everywhere
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  /// Along the meridian: of the circle through a point of the profile and its neighbours, so that an edge has
  /// about the length of its segments. Around the axis: the distance to the axis along the normal (Meusnier).
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override;
  std::array<bool, 3> symmetric() const override { return {true, true, mirrored_}; }
  MassProperties mass_properties() const override;
  const char* kind() const override { return "profile"; }
  std::string definition() const override;

 private:
  /// The point of the profile that reaches farthest along (n_r, n_z).
  std::size_t farthest(double n_r, double n_z) const;
  double meridian_curvature(std::size_t point) const;  // 1/m, positive: convex

  Profile profile_;
  bool mirrored_;  // about z = 0
};

}  // namespace granulaw
