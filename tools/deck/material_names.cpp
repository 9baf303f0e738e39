#include "deck/material_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/error.hpp"

namespace granulaw::deck {

namespace {

/// The atom types whose bodies deform: particles, and walls that the deck calls deformable.
std::set<int> deforming_types(const Scene& scene)
{
  std::set<int> types;
  for (const Source& s : scene.sources) types.insert(s.type);
  if (types.empty()) types.insert(1);  // the plan's particles where the deck shows none
  for (const Wall& w : scene.walls)
    if (w.deformable) types.insert(w.type);
  return types;
}

/// The material of an atom type as the deck describes it, elastic; none if it does not.
std::optional<LawMaterial> material_by_deck(const std::string& name, int type, const Scene& scene)
{
  const auto found = scene.materials.find(type);
  if (found == scene.materials.end() || !found->second.has_moduli()) return std::nullopt;
  LawMaterial m;
  m.name = name;
  m.youngs_modulus = *found->second.youngs_modulus;
  m.poisson_ratio = *found->second.poisson_ratio;
  for (const Source& s : scene.sources)
    if (s.type == type) m.density = s.density;
  return m;
}

}  // namespace

void name_materials(PlanOptions& into, const Scene& scene, const NamedMaterials& materials, const std::vector<std::string>& given, bool from_file)
{
  const std::vector<std::string>& names = given.empty() ? scene.material_names : given;
  const auto& [path, known] = materials;
  // one material, one type: there is nothing to name
  if (from_file && names.empty() && known.size() == 1 && scene.types <= 1) into.materials[1] = known.begin()->second;
  if (known.empty()) return;
  const std::string who = !given.empty() ? "--materials" : fmt::format("{}: 'materials' of pair_style", scene.deck);
  if (scene.types > 0 && names.size() > static_cast<std::size_t>(scene.types))
    fail(who, fmt::format("more names than the deck's {} atom types", scene.types), fmt::format("{}", fmt::join(names, " ")));
  std::vector<std::string> known_names;
  for (const auto& entry : known) known_names.push_back(entry.first);
  const std::set<int> deforming = deforming_types(scene);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const int type = static_cast<int>(k) + 1;
    if (const auto m = known.find(names[k]); m != known.end()) {
      into.materials[type] = m->second;
      continue;
    }
    const auto by_deck = material_by_deck(names[k], type, scene);
    if (names[k] != elastic_name && deforming.contains(type)) fail_unknown(who, fmt::format("{} has no material for atom type {}", path, type), names[k], known_names);
    if (by_deck) into.materials[type] = *by_deck;
  }
}

namespace {

/// Decks round to four figures.
constexpr double tolerance = 1e-3;

/// Particles of the type, of the largest density.
Source heaviest(const Scene& scene, int type)
{
  Source found;
  for (const Source& s : scene.sources)
    if (s.type == type && s.density > found.density) found = s;
  return found;
}

}  // namespace

std::string OtherDensity::sentence() const
{
  return fmt::format(
      "the materials file says {:.4g} kg/m^3, the deck's particles have {:.4g}: theirs is used{}{}", of_material, of_deck, reason.empty() ? "" : ". ", reason);
}

std::vector<OtherDensity> other_densities(const Scene& scene, const PlanOptions& options)
{
  std::vector<OtherDensity> others;
  for (const auto& [type, material] : options.materials) {
    const Source s = heaviest(scene, type);
    if (!(s.density > 0 && material.density > 0) || std::abs(material.density / s.density - 1) <= tolerance) continue;
    OtherDensity other{type, material.name, s.density, material.density, {}};
    if (scene.dimension == 2)
      other.reason = fmt::format(
          "Under 'dimension 2' LIGGGHTS gives a sphere the mass of a disk one unit of length thick; a density of {:.4g} kg/m^3 in the deck (4/3 R times the material's, R in that unit) gives it a sphere's",
          material.density * 4.0 / 3.0 * s.radius_min / (scene.units == "cgs" ? 0.01 : 1.0));
    others.push_back(other);
  }
  return others;
}

}  // namespace granulaw::deck
