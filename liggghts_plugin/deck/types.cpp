#include "liggghts_plugin/deck/types.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "fix_gravity.h"
#include "fix_property_global.h"
#include "fix_template_sphere.h"
#include "liggghts_plugin/deck/particle_sizes.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

namespace granulaw::plugin {

namespace {

/// Flags the types of existing particles and of those that a fix can still insert.
void find_particle_types(LAMMPS_NS::LAMMPS* lmp, Types& types)
{
  const LAMMPS_NS::Atom& atom = *lmp->atom;
  const auto include_density = [&](int t, double in_deck_units) {
    const double density = in_deck_units * types.units.density();
    types.density_low[t] = std::min(types.density_low[t], density);
    types.density_high[t] = std::max(types.density_high[t], density);
  };
  const bool is_flat = lmp->domain->dimension == 2;
  for (int a = 0; a < atom.nlocal; ++a) {
    const int t = atom.type[a];
    types.of_particles[t] = 1;
    if (is_flat && atom.rmass) include_density(t, atom.rmass[a] / (4.0 / 3.0 * M_PI * std::pow(atom.radius[a], 3)));
    else if (atom.density) include_density(t, atom.density[a]);
  }
  each_template(lmp, [&](LAMMPS_NS::FixTemplateSphere& particle, double density) {
    for (int t = particle.mintype(); t <= particle.maxtype(); ++t) include_density(t, density);
  });
  for (int f = 0; f < lmp->modify->nfix; ++f)
    for (int t = 1; t <= types.count; ++t)
      if (lmp->modify->fix[f]->max_rad(t) > 0.0) types.of_particles[t] = 1;
  const int n = types.count + 1;
  MPI_Allreduce(MPI_IN_PLACE, types.of_particles.data(), n, MPI_INT, MPI_MAX, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, types.density_low.data(), n, MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, types.density_high.data(), n, MPI_DOUBLE, MPI_MAX, lmp->world);
}

void find_wall_types(LAMMPS_NS::FixWallGran& wall, Types& types)
{
  if (!wall.is_mesh_wall()) {
    types.of_wall[wall.atom_type_wall()] = 1;
    return;
  }
  for (int m = 0; m < wall.n_meshes(); ++m) types.of_wall[wall.mesh_list()[m]->atomTypeWall()] = 1;
}

}  // namespace

Types gather_types(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry& registry, const Setup& setup)
{
  Types types;
  types.units = DeckUnits::of(lmp->update->unit_style, setup.where);
  types.count = lmp->atom->ntypes;
  const auto n = static_cast<std::size_t>(types.count + 1);
  types.youngs_modulus.assign(n, std::numeric_limits<double>::quiet_NaN());
  types.poisson_ratio = types.youngs_modulus;
  types.of_particles.assign(n, 0);
  types.of_wall.assign(n, 0);
  types.density_low.assign(n, std::numeric_limits<double>::infinity());
  types.density_high.assign(n, 0.0);

  const std::string caller = setup.where;
  registry.registerProperty("youngsModulus", &MODEL_PARAMS::createYoungsModulus);
  registry.registerProperty("poissonsRatio", &MODEL_PARAMS::createPoissonsRatio);
  const double* youngs_modulus = registry.getVectorProperty("youngsModulus", caller.c_str())->data;
  const double* poisson_ratio = registry.getVectorProperty("poissonsRatio", caller.c_str())->data;
  for (int t = 1; t <= std::min(types.count, registry.max_type()); ++t) {
    types.youngs_modulus[t] = youngs_modulus[t] * types.units.pressure();
    types.poisson_ratio[t] = poisson_ratio[t];
  }
  find_particle_types(lmp, types);
  if (setup.wall) find_wall_types(*setup.wall, types);
  return types;
}

void refuse_unstated_restitution(LAMMPS_NS::LAMMPS* lmp, const Setup& setup)
{
  if (setup.options.elastic_damping) return;
  if (lmp->modify->find_fix_property("coefficientRestitution", "property/global", "peratomtypepair", 0, 0,
                                     "granulaw", false))
    fail(
        setup.where,
        "the deck sets 'coefficientRestitution', and restitution follows from the contact law: remove it, or "
        "say 'elasticDamping off' or 'elasticDamping Z' (it is for other models), or 'elasticDamping "
        "restitution' (it damps contacts below yield)");
}

std::vector<double> damping_ratios(PropertyRegistry& registry, const Setup& setup, const Types& types)
{
  const ElasticDamping damping = setup.options.elastic_damping.value_or(ElasticDamping{});
  const int stride = types.count + 1;
  std::vector<double> ratios(static_cast<std::size_t>(stride * stride), damping.ratio);
  if (!damping.from_restitution) return ratios;
  registry.registerProperty("coeffRest", &MODEL_PARAMS::createCoeffRest);
  const double* const* restitution = registry.getMatrixProperty("coeffRest", setup.where.c_str())->data;
  for (int i = 1; i <= std::min(types.count, registry.max_type()); ++i)
    for (int j = 1; j <= std::min(types.count, registry.max_type()); ++j) {
      const double loss = -std::log(restitution[i][j]);  // e = exp(-pi Z/sqrt(1 - Z^2))
      ratios[static_cast<std::size_t>(i * stride + j)] = loss / std::hypot(loss, M_PI);
    }
  return ratios;
}

double pair_number(LAMMPS_NS::LAMMPS* lmp, const char* name, int i, int j, double otherwise)
{
  const int types = lmp->atom->ntypes;
  if (auto* all = lmp->modify->find_fix_property(name, "property/global", "scalar", 0, 0, "granulaw", false)) return all->compute_scalar();
  if (auto* each = lmp->modify->find_fix_property(name, "property/global", "peratomtypepair", types, types, "granulaw", false))
    return each->compute_array(i - 1, j - 1);
  return otherwise;
}

double gravity_of(LAMMPS_NS::LAMMPS* lmp)
{
  double sum = 0.0;
  for (int k = 0; k < lmp->modify->nfix; ++k) {
    auto* gravity = dynamic_cast<LAMMPS_NS::FixGravity*>(lmp->modify->fix[k]);
    if (!gravity) continue;
    double g[3];
    gravity->init();  // it has no value before
    gravity->get_gravity(g);
    sum += std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  }
  return sum;
}

}  // namespace granulaw::plugin
