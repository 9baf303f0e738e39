#pragma once

#include <vector>

#include "liggghts_plugin/engine/deck_units.hpp"

class PropertyRegistry;  // LIGGGHTS's
namespace LAMMPS_NS {
class LAMMPS;
}

namespace granulaw::plugin {

struct Setup;

/// Properties of the atom types that a law requires when a run begins. Index 0 is unused: types count from 1.
struct Types
{
  int count = 0;
  DeckUnits units;
  std::vector<double> youngs_modulus, poisson_ratio;  ///< Pa, -; NaN where no particle or wall has the type
  std::vector<int> of_particles;                      ///< type of a particle that exists or can be inserted
  std::vector<int> of_wall;                           ///< type of this wall (walls only)
  std::vector<double> density_low, density_high;      ///< kg/m^3, templates included; low > high: none

  /// True if a contact of types i and j can happen; at a wall j is the wall's.
  bool can_meet(int i, int j, bool is_wall) const
  {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    return of_particles[a] && (is_wall ? of_wall[b] : of_particles[b]);
  }
};

/// Collective. Throws Error if a property is missing or the units are neither SI nor cgs.
Types gather_types(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup);

/// Throws Error where the deck sets coefficientRestitution and does not say with `elasticDamping` whether it
/// is to be used: a Hertz deck's value holds the plastic loss that the law itself computes.
void refuse_unstated_restitution(LAMMPS_NS::LAMMPS* lmp, const Setup& setup);
/// The damping ratio Z of each pair of types, at [i * (count + 1) + j].
std::vector<double> damping_ratios(PropertyRegistry& registry, const Setup& setup, const Types& types);

/// The deck's number NAME of types i and j, a property/global scalar or peratomtypepair; `otherwise` where it has none.
double pair_number(LAMMPS_NS::LAMMPS* lmp, const char* name, int i, int j, double otherwise);
/// m/s^2 in the deck's units; 0: there is no fix gravity.
double gravity_of(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
