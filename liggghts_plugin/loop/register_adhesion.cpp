// `cohesion dent` of model mpm (contact/adhesion.hpp).
#include "contact/adhesion.hpp"
#include "liggghts_plugin/contact/mpm_physics.hpp"
#include "liggghts_plugin/loop/registration.hpp"

namespace granulaw::plugin {

static_assert(StandsBeside<DentAdhesion, MpmContact>);

namespace {

/// In restart files: never change it, never use it twice. LIGGGHTS's own end at 12.
constexpr int dent_id = 52;

[[maybe_unused]] const bool registered = (add_beside<MpmPhysics, DentAdhesion>(own_cohesion_model.data(), dent_id), true);

}  // namespace

}  // namespace granulaw::plugin
