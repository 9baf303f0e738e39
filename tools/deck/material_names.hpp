#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/plan_options.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

/// A file that names materials, and they; empty: none.
struct NamedMaterials
{
  std::string path;
  std::map<std::string, LawMaterial> known;
};

/// Materials of the atom types by the names that a caller (`given`, --materials), else the deck's pair_style
/// gives them. A name that the file lacks stays as the deck describes it where its type has walls only, which
/// are rigid, and where it is the plug-in's own `elastic`. Throws Error for any other. `from_file`: the one
/// material of a materials file needs no name where the deck has one type.
void name_materials(PlanOptions& into, const Scene& scene, const NamedMaterials& materials, const std::vector<std::string>& given, bool from_file);

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
