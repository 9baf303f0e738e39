#pragma once

#include "solver/shape/solid.hpp"

namespace granulaw {

/// LIGGGHTS's superquadric about the origin (superquadric.cpp, shape_function_local): half axes a, b, c and
/// `blockiness` n1, n2, both 2 or more, so that it is convex:
///
///     (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1
///
/// The depth is the distance to the surface point found by Newton's method from the nearest of the surface
/// points along the axes and the radius: the distance itself but for places deep inside, where it may be too
/// large.
class SuperquadricSolid : public Solid
{
 public:
  SuperquadricSolid(const Vector3& half_axes, double n1, double n2) : axes_(half_axes), n1_(n1), n2_(n2) {}

  double depth(const Vector3& x) const override;
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override;
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override;
  const char* kind() const override { return "superquadric"; }
  std::string definition() const override;

 private:
  /// The shape function to the power 1/n1, a norm: 1 on the surface, t at t times a surface point.
  double gauge(const Vector3& x) const;
  /// Gradient and Hessian of the shape function; x in the positive octant.
  void derivatives(const Vector3& x, Vector3& gradient, Eigen::Matrix3d& hessian) const;
  Vector3 nearest_of_starts(const Vector3& x) const;
  Vector3 nearest_surface_point(const Vector3& x) const;  // x in the positive octant

  Vector3 axes_;    // m
  double n1_, n2_;  // along z; in x and y
};

}  // namespace granulaw
