#pragma once

#include <string>

#include "solver/shape/mesh_solid.hpp"

namespace granulaw {

/// All points within `edge_radius` of the convex hull of `corners`: a convex polyhedron with rounded edges
/// and corners.
class PolyhedronSolid : public Solid
{
 public:
  PolyhedronSolid(const std::vector<Vector3>& corners, double edge_radius, const std::string& where);

  double depth(const Vector3& x) const override
  {
    return hull_.depth(x) + edge_radius_;
  }  ///< the distance itself
  Vector3 outward_normal(const Vector3& x) const override { return hull_.outward_normal(x); }
  double support(const Vector3& direction, Vector3* where) const override;
  /// `edge_radius` along an edge, and both ways at a corner; directions within 1e-9 of a face's or an edge's
  /// count as its.
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  double finest_radius() const override { return edge_radius_; }
  /// Of the mesh of the support points of some 1e5 directions: within 1e-4.
  MassProperties mass_properties() const override;
  const char* kind() const override { return "polyhedron"; }
  std::string definition() const override;

 private:
  MeshSolid hull_;
  double edge_radius_;
};

}  // namespace granulaw
