// A tangential law of ours for the model plain_hertz: `tangential own_spring` is LIGGGHTS's `history` by
// Spring.
#include "liggghts_plugin/loop/registration.hpp"
#include "plain_hertz_physics.hpp"

namespace granulaw::plugin {

static_assert(TangentialLaw<Spring, PlainHertzContact>);

namespace {

[[maybe_unused]] const bool registered = (add_tangential<PlainHertzPhysics, Spring>("own_spring", 50), true);

}  // namespace

}  // namespace granulaw::plugin
