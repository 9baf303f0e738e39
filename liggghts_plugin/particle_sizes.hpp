#pragma once

#include <cstddef>
#include <vector>

#include "liggghts_plugin/size_choice.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace granulaw::plugin {

/// Least radius and mass and largest radius of each atom type, in the deck's units, of particles that exist
/// and templates that fixes can insert; infinity, and 0 for the largest: there is none. Index 0 is unused.
struct ParticleSizes
{
  std::vector<double> radius, mass, largest_radius;

  Radii of_type(int t) const
  {
    const auto at = static_cast<std::size_t>(t);
    return {radius[at], largest_radius[at]};
  }
};

/// Collective. A template's density is its mean one.
ParticleSizes particle_sizes(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
