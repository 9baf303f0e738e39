#include "liggghts_plugin/smallest.hpp"

#include <cmath>
#include <limits>

#include "fix_template_sphere.h"
#include "liggghts_plugin/liggghts.hpp"

namespace granulaw::plugin {

Smallest smallest_particles(LAMMPS_NS::LAMMPS* lmp)
{
  const LAMMPS_NS::Atom& atom = *lmp->atom;
  const auto n = static_cast<std::size_t>(atom.ntypes + 1);
  Smallest least{std::vector<double>(n, std::numeric_limits<double>::infinity()),
                 std::vector<double>(n, std::numeric_limits<double>::infinity())};
  for (int a = 0; a < atom.nlocal; ++a) {
    const int t = atom.type[a];
    least.radius[t] = std::min(least.radius[t], atom.radius[a]);
    if (atom.rmass) least.mass[t] = std::min(least.mass[t], atom.rmass[a]);
  }
  for (int f = 0; f < lmp->modify->nfix; ++f) {
    auto* particle = dynamic_cast<LAMMPS_NS::FixTemplateSphere*>(lmp->modify->fix[f]);
    if (!particle || particle->is_relative()) continue;
    const double radius = particle->min_rad(), density = particle->massexpect() / particle->volexpect();
    if (!(radius > 0) || !(density > 0)) continue;
    for (int t = particle->mintype(); t <= particle->maxtype(); ++t) {
      least.radius[t] = std::min(least.radius[t], radius);
      least.mass[t] = std::min(least.mass[t], 4.0 / 3.0 * M_PI * radius * radius * radius * density);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, least.radius.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, least.mass.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MIN, lmp->world);
  return least;
}

}  // namespace granulaw::plugin
