#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/plan_options.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

/// The density of a type's particles, where the materials file has another.
struct OtherDensity
{
  int type = 1;
  std::string name;                     ///< of the material
  double of_deck = 0, of_material = 0;  ///< kg/m^3; of the deck: mass over the sphere's volume, the largest
  std::string reason;                   ///< empty: the deck says so
  std::string sentence() const;
};
std::vector<OtherDensity> other_densities(const Scene& scene, const PlanOptions& options);

}  // namespace granulaw::deck
