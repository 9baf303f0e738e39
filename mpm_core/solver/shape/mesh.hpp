#pragma once

#include <string>
#include <vector>

#include "solver/shape/shape.hpp"

namespace granulaw {

/// Triangles that enclose one body, their corners counter-clockwise seen from outside.
struct TriangleMesh
{
  std::vector<Vector3> vertices;              ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices into vertices
};

/// Joins equal corners to vertices; triangles with two equal corners are left out. An STL's, times `scale`.
TriangleMesh read_triangle_mesh(const std::string& path, double scale);

/// Throws Error "WHERE: ..." with one sentence if the triangles do not enclose one body: open, more than two
/// triangles at an edge, wound in different senses, inside out, in several pieces. That the surface does not
/// cross itself is not checked.
void check_closed(const TriangleMesh& mesh, const std::string& where);

/// Mass properties of the enclosed body, exact: a sum of tetrahedra about the origin.
MassProperties mass_properties_of(const TriangleMesh& mesh);

}  // namespace granulaw
