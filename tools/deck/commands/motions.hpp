#pragma once

#include <string>

#include "deck/commands/handlers.hpp"
#include "deck/geometry.hpp"

namespace granulaw::deck {

/// A fix move/mesh while it is on.
struct Motion
{
  std::string mesh;
  Vec3 velocity{0, 0, 0};   ///< of a linear one
  Vec3 amplitude{0, 0, 0};  ///< of a wiggling one
  bool turns = false;       ///< about the axis through the origin
  Vec3 origin{0, 0, 0}, axis{0, 0, 1};
};

/// `fix ID group move/mesh mesh MESH STYLE ...`
void follow_motion(Reading& reading, const Fix& fix, Words words);

/// Moves the meshes, and the walls made of them, over all that they reach within `duration`.
void move_meshes(Reading& reading, double duration);

}  // namespace granulaw::deck
