#pragma once

#include <string>
#include <vector>

#include "deck/commands/handlers.hpp"
#include "deck/geometry.hpp"

namespace granulaw::deck {

/// A mesh as its own line and its motions place it.
struct Mesh
{
  std::string where;
  int type = 1;
  Box box;
  double speed = 0;                ///< largest of its points under fix move/mesh
  double drag_speed = 0;           ///< of its surface along itself
  std::vector<std::size_t> walls;  ///< those made of it, in Scene::walls
};

/// `fix ID group mesh/surface... file FILE ...`
void follow_mesh(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
