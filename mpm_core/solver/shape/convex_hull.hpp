#pragma once

#include <string>
#include <vector>

#include "solver/shape/triangle_mesh.hpp"

namespace granulaw {

/// Surface of the smallest convex body that holds the points; those inside it or on its faces and edges are
/// left out. For some hundred points: the time goes with the fourth power. Throws Error "WHERE: ..." if they
/// span no volume.
TriangleMesh convex_hull(const std::vector<Vector3>& points, const std::string& where);

}  // namespace granulaw
