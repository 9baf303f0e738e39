#include "liggghts_plugin/mpm_physics.hpp"

#include <fmt/ranges.h>

namespace granulaw::plugin {

namespace {

/// The law was computed for the material's moduli and the tangential force takes the deck's: they must be
/// one. 1e-3 lets a deck round its numbers to four figures.
constexpr double modulus_tolerance = 1e-3;

bool agree(double found, double expected)
{
  return std::abs(found - expected) <= modulus_tolerance * std::abs(expected);
}

void check_material(LAMMPS_NS::LAMMPS* lmp, const Setup& setup, const Types& types, int t,
                    const LawMaterial& material)
{
  const double found_e = types.youngs_modulus[t], found_nu = types.poisson_ratio[t];
  if (!agree(found_e, material.youngs_modulus))
    fail(setup.where,
         fmt::format("youngsModulus of type {} is {:.6g} Pa in the deck and {:.6g} Pa for '{}' in {}", t,
                     found_e, material.youngs_modulus, material.name, setup.law->path));
  // a Poisson's ratio may be 0: compare to 1e-3 of one
  if (std::abs(found_nu - material.poisson_ratio) > modulus_tolerance)
    fail(setup.where, fmt::format("poissonsRatio of type {} is {:.6g} in the deck and {:.6g} for '{}' in {}",
                                  t, found_nu, material.poisson_ratio, material.name, setup.law->path));
  const bool density_differs =
      types.density_low[t] <= types.density_high[t] &&
      !(agree(types.density_low[t], material.density) && agree(types.density_high[t], material.density));
  if (density_differs && setup.session->first_time(fmt::format("density {}", t)) && lmp->comm->me == 0)
    lmp->error->warning(
        FLERR, fmt::format("{}: particles of type {} have density {:.6g} to {:.6g} kg/m^3, '{}' in {} "
                           "has {:.6g}: the force law does not depend on it, its limit of velocity does",
                           setup.where, t, types.density_low[t], types.density_high[t], material.name,
                           setup.law->path, material.density)
                   .c_str());
}

}  // namespace

void MpmPhysics::prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry&, const Setup& setup, const Types& types)
{
  setup_ = &setup;
  const auto& materials = setup.options.materials;
  if (materials.size() != static_cast<std::size_t>(types.count)) {
    // names end where the next keyword begins, so a misspelt keyword looks like one more material
    std::string hint;
    const auto words = keywords(Model::mpm, setup.wall != nullptr);
    for (std::size_t k = static_cast<std::size_t>(types.count); k < materials.size() && hint.empty(); ++k)
      if (const std::string word = nearest(materials[k], words); !word.empty())
        hint = fmt::format("; '{}' is no keyword, did you mean '{}'?", materials[k], word);
    fail(setup.where, fmt::format("'materials' needs one name for each of the {} atom types, found {}: {}{}",
                                  types.count, materials.size(), fmt::join(materials, " "), hint));
  }
  for (int t = 1; t <= types.count; ++t) {
    const auto found = setup.law->law.bodies.find(materials[static_cast<std::size_t>(t - 1)]);
    if (found == setup.law->law.bodies.end() || std::isnan(types.youngs_modulus[t])) continue;
    check_material(lmp, setup, types, t, found->second.material);
    double& limit = setup.session->inertia_limit;
    if (const double own = found->second.certificate.max_inertia; own > 0 && (limit == 0 || own < limit))
      limit = own;
  }
}

}  // namespace granulaw::plugin
