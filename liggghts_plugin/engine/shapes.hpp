#pragma once

#include <cmath>

#include "liggghts_plugin/engine/liggghts.hpp"

// Which shapes of particles the models are built for. LIGGGHTS's own build says it: SUPERQUADRIC_ACTIVE_FLAG
// adds `reff` and `contact_point` to what a contact model is given. Without it only spheres are built, and
// nothing here costs them anything.
namespace granulaw::plugin {

namespace cm = LIGGGHTS::ContactModels;

#ifdef SUPERQUADRIC_ACTIVE_FLAG
inline constexpr bool superquadrics_built = true;
#else
inline constexpr bool superquadrics_built = false;
#endif

/// Surface models and the cohesion models they are built with: `cohesion sjkr` takes spheres' contact areas.
constexpr bool surface_is_built(int surface, int cohesion)
{
  return surface == cm::SURFACE_DEFAULT ||
         (superquadrics_built && surface == cm::SURFACE_SUPERQUADRIC && cohesion == cm::COHESION_OFF);
}
inline constexpr const char* built_surfaces =
    superquadrics_built ? "surface default, with cohesion off also superquadric" : "surface default";

/// m, of the sphere of the same volume where the particle is a superquadric, else the particle's radius.
inline double volume_radius(const LAMMPS_NS::Atom& atom, int i)
{
  if constexpr (superquadrics_built)
    if (atom.superquadric_flag) return std::cbrt(0.75 / M_PI * atom.volume[i]);
  return atom.radius[i];
}

}  // namespace granulaw::plugin
