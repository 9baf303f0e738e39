#pragma once

#include <functional>
#include <string>

#include "deck/commands/insertion.hpp"
#include "deck/commands/meshes.hpp"
#include "deck/commands/motions.hpp"
#include "deck/commands/named.hpp"
#include "deck/commands/regions.hpp"
#include "deck/commands/templates.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

/// What a deck has said so far, in its own units. The handlers of commands use it and add to it.
struct Reading
{
  Scene scene;
  double time_step = 0;       ///< of the runs to come
  double steps = 0;           ///< run so far
  double lattice_volume = 0;  ///< of one cell; 0: no lattice
  Named<Region> regions{"region"};
  Named<Mesh> meshes{"mesh"};
  Named<Motion> motions{"move/mesh"};  ///< those that are on
  Named<Template> templates{"particletemplate"};
  Named<Distribution> distributions{"particledistribution"};
  Named<Insertion> insertions{"insertion"};  ///< those that are on
  /// Adds to Scene::notes: where, what.
  std::function<void(const std::string&, const std::string&)> note;
};

}  // namespace granulaw::deck
