#include "deck/densities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace granulaw::deck {

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
