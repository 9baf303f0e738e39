#include "liggghts_plugin/deck/particle_sizes.hpp"

#include <cmath>
#include <limits>

#include "fix_template_sphere.h"
#include "liggghts_plugin/engine/shapes.hpp"
#include "liggghts_plugin/particles/bodies.hpp"

namespace granulaw::plugin {

void each_template(LAMMPS_NS::LAMMPS* lmp,
                   const std::function<void(LAMMPS_NS::FixTemplateSphere&, double density)>& visit)
{
  for (int f = 0; f < lmp->modify->nfix; ++f) {
    auto* particle = dynamic_cast<LAMMPS_NS::FixTemplateSphere*>(lmp->modify->fix[f]);
    if (!particle) continue;
    const double density = particle->massexpect() / particle->volexpect();
    if (density > 0 && std::isfinite(density)) visit(*particle, density);
  }
}

ParticleSizes particle_sizes(LAMMPS_NS::LAMMPS* lmp)
{
  const LAMMPS_NS::Atom& atom = *lmp->atom;
  const auto n = static_cast<std::size_t>(atom.ntypes + 1);
  constexpr double none = std::numeric_limits<double>::infinity();
  ParticleSizes sizes{std::vector<double>(n, none), std::vector<double>(n, none),
                      std::vector<double>(n, 0.0)};
  const std::vector<bool> enclosed = Bodies::enclosed(lmp);
  for (int a = 0; a < atom.nlocal; ++a) {
    if (!enclosed.empty() && enclosed[static_cast<std::size_t>(a)]) continue;
    const int t = atom.type[a];
    const double radius = volume_radius(atom, a);
    sizes.radius[t] = std::min(sizes.radius[t], radius);
    sizes.largest_radius[t] = std::max(sizes.largest_radius[t], radius);
    if (atom.rmass) sizes.mass[t] = std::min(sizes.mass[t], atom.rmass[a]);
  }
  each_template(lmp, [&](LAMMPS_NS::FixTemplateSphere& particle, double density) {
    if (particle.is_relative()) return;
    double radius = Bodies::smallest_radius(particle), largest = particle.max_rad();
    if (superquadrics_built && atom.superquadric_flag)  // these two are of bounding spheres then
      radius = largest = std::cbrt(0.75 / M_PI * particle.volexpect());
    if (!(radius > 0)) return;
    for (int t = particle.mintype(); t <= particle.maxtype(); ++t) {
      sizes.radius[t] = std::min(sizes.radius[t], radius);
      sizes.largest_radius[t] = std::max(sizes.largest_radius[t], largest);
      sizes.mass[t] = std::min(sizes.mass[t], 4.0 / 3.0 * M_PI * radius * radius * radius * density);
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, sizes.radius.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, sizes.mass.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, sizes.largest_radius.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MAX,
                lmp->world);
  return sizes;
}

}  // namespace granulaw::plugin
