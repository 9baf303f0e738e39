#pragma once

#include "solver/shape/triangle_mesh.hpp"

namespace granulaw {

class TriangleTree;

/// The body inside a closed triangle mesh.
class MeshSolid : public Solid
{
 public:
  /// Throws Error "WHERE: ..." if the mesh is not closed (check_closed).
  MeshSolid(TriangleMesh mesh, const std::string& where);

  double depth(const Vector3& x) const override;  ///< the distance itself, everywhere
  Vector3 outward_normal(const Vector3& x) const override;
  double support(const Vector3& direction, Vector3* where) const override;
  /// Of a paraboloid fitted to the vertices within a tenth of the radius of the sphere of the body's volume
  /// about the support point: the curvature that a contact of about that size has. Wider where fewer than 12
  /// vertices lie there; 0 and 0 of a mesh with fewer than 6 around the point.
  PrincipalRadii principal_radii(const Vector3& direction) const override;
  /// Of paraboloids fitted to two rings of neighbours about each vertex: of a sharp edge about the size of
  /// its triangles.
  double finest_radius() const override { return finest_; }
  MassProperties mass_properties() const override { return mass_; }
  const char* kind() const override { return "mesh"; }
  std::string definition() const override;
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  std::shared_ptr<const TriangleTree> tree_;
  MassProperties mass_;
  double patch_, finest_;
};

}  // namespace granulaw
