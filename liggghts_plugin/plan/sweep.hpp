#pragma once

#include <functional>
#include <vector>

#include "liggghts_plugin/engine/liggghts.hpp"
#include "liggghts_plugin/plan/mesh_motion.hpp"

namespace granulaw::plugin::plan {

struct MeshView
{
  Box box;
  std::vector<MeshMotion::Triangle> corners, velocities;
};
/// A mesh as it is now.
MeshView look_at(LAMMPS_NS::FixMeshSurface& mesh);

bool is_moved(LAMMPS_NS::LAMMPS* lmp, const LAMMPS_NS::FixMeshSurface& mesh);

/// Moves all meshes by their fix move/mesh over `steps` time steps, in some hundred strides, and calls
/// `visit` after each.
void sweep(LAMMPS_NS::LAMMPS* lmp, double steps, const std::function<void()>& visit);

}  // namespace granulaw::plugin::plan
