#pragma once

#include "liggghts_plugin/energy_tally.hpp"

namespace granulaw::plugin {

/// Adds the per-atom properties that `energy on` and `computeDissipatedEnergy on` ask for, where the deck has
/// none yet.
void provide_energy_properties(LAMMPS_NS::LAMMPS* lmp);

/// Tells EnergyTally where the properties of this step lie (they move when particles come in), and clears
/// what is stored.
void find_energy_properties(LAMMPS_NS::LAMMPS* lmp, EnergyTally& books, bool dissipated_energy);

}  // namespace granulaw::plugin
