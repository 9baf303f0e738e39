#pragma once

#include "liggghts_plugin/energy_tally.hpp"

namespace granulaw::plugin {

/// Adds the per-atom properties that `energy on` and `computeDissipatedEnergy on` ask for, where the deck has
/// none yet.
void provide_energy_properties(LAMMPS_NS::LAMMPS* lmp);

/// Tells EnergyTally where the properties lie: they move when particles come in.
void find_energy_properties(LAMMPS_NS::LAMMPS* lmp, EnergyTally& books, bool dissipated_energy);
/// Before the forces of a step: clears what particles hold.
void clear_stored_energy(LAMMPS_NS::LAMMPS* lmp, EnergyTally& books);

}  // namespace granulaw::plugin
