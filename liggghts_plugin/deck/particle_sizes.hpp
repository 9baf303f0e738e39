#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "law/size_choice.hpp"

namespace LAMMPS_NS {
class FixTemplateSphere;
class LAMMPS;
}

namespace granulaw::plugin {

/// Least radius and mass and largest radius of each atom type, in the deck's units, of particles that exist
/// and templates that fixes can insert, without spheres within another one of their clump; infinity, and 0 for the largest: there is
/// none. Index 0 is unused.
struct ParticleSizes
{
  std::vector<double> radius, mass, largest_radius;

  Radii of_type(int t) const
  {
    const auto at = static_cast<std::size_t>(t);
    return {radius[at], largest_radius[at]};
  }
};

/// Each particle template of the deck, with its mean density, in the deck's units.
void each_template(LAMMPS_NS::LAMMPS* lmp,
                   const std::function<void(LAMMPS_NS::FixTemplateSphere&, double density)>& visit);

/// Collective. A template's density is its mean one.
ParticleSizes particle_sizes(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
