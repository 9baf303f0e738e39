#pragma once

#include "solver/contact/scene.hpp"
#include "solver/loading/programme.hpp"

namespace granulaw {

/// One step of the material point method, as verbs in order. Velocities live half a step before `time`:
/// `kick` is half the last step plus half this one, `dt`. (With kick = dt the scheme would be of first order
/// while the step changes: at V/V_y = 1500 it shrinks fivefold, and 1e-3 of the energy is lost.) Returns the
/// impulse of the contact on the first body.
double advance(Scene& scene, Programme& programme, double time, double kick, double dt);

}  // namespace granulaw
