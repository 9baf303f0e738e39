#pragma once

#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace granulaw::plugin {

/// Least radius (m) and mass (kg) of each atom type, of particles that exist and templates that fixes can
/// insert; infinity: there is none. Index 0 is unused.
struct Smallest
{
  std::vector<double> radius, mass;
};

/// Collective. A template's density is its mean one.
Smallest smallest_particles(LAMMPS_NS::LAMMPS* lmp);

}  // namespace granulaw::plugin
