#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

/// Names of a wall's planes. A primitive is one; triangles of its meshes that lie in one plane are one. The name follows from the
/// wall's id and the triangles' numbers alone: equal on all ranks and behind a restart.
class WallPlanes
{
 public:
  /// Negative, above -2^53: a double holds it.
  using Key = std::int64_t;

  /// Collective: meshes are shared between ranks.
  WallPlanes(FixWallGran& wall, MPI_Comm world);

  /// `triangle`: its number in the mesh, -1 of a primitive.
  Key key(int mesh, int triangle) const;
  Key first_key() const { return first_; }

 private:
  Key first_;
  std::vector<std::unordered_map<int, int>> plane_;  // of each mesh, by the triangle's number
};

}  // namespace granulaw::plugin
