#pragma once

#include <memory>

#include "solver/shape/triangle_mesh.hpp"

namespace granulaw {

/// Signed distance to a closed triangle mesh. Boost.Geometry's R-tree finds the nearest triangle; the side is
/// that of the angle-weighted normal of the nearest face, edge or vertex (Baerentzen and Aanaes 2005), which
/// is exact.
class TriangleTree
{
 public:
  explicit TriangleTree(const TriangleMesh& mesh);  // keeps a reference to nothing
  ~TriangleTree();

  struct Nearest
  {
    double depth;    ///< m, positive inside
    Vector3 point;   ///< of the surface
    Vector3 normal;  ///< outward normal of that point's face, edge or vertex; of length 1
  };
  Nearest nearest(const Vector3& x) const;
  /// Angle-weighted mean normals of the vertices, of length 1.
  const std::vector<Vector3>& vertex_normals() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace granulaw
