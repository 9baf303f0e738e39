#pragma once

#include <functional>

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// Calls `bring`, which adds particles. Where it throws Unknown, the plan asks for them.
void bring_particles(Reading& reading, const Words& words, const std::function<void()>& bring);

/// `create_atoms TYPE single|region|box|random ...`
void follow_create_atoms(Reading& reading, Words words);
/// `set KIND WHICH KEYWORD VALUE...`
void follow_set(Reading& reading, Words words);
/// `velocity GROUP set X Y Z`: of every particle, whatever the group.
void follow_velocity(Reading& reading, Words words);
/// `displace_atoms`, `displace_box`
void follow_displacement(Reading& reading, Words words);

/// `fix adapt`: changes the particles while it runs.
void follow_adapt(Reading& reading, const Fix& fix, Words words);
/// `fix multisphere`, `rigid`: bodies of several spheres.
void follow_clumps(Reading& reading, const Fix& fix, Words words);
/// Fixes that change velocities.
void follow_force(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
