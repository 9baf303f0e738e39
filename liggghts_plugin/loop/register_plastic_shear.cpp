// `tangential plastic` of model mpm (contact/plastic_shear.hpp).
#include "contact/plastic_shear.hpp"
#include "liggghts_plugin/contact/mpm_physics.hpp"
#include "liggghts_plugin/loop/registration.hpp"

namespace granulaw::plugin {

static_assert(TangentialLaw<PlasticShear, MpmContact>);

namespace {

/// In restart files: never change it, never use it twice. LIGGGHTS's own end at 3.
constexpr int plastic_id = 20;

[[maybe_unused]] const bool registered = (add_tangential<MpmPhysics, PlasticShear>(own_tangential_model.data(), plastic_id), true);

}  // namespace

}  // namespace granulaw::plugin
