#pragma once

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

// What holds for the whole scene: units, box, gravity, time step.

void follow_atom_style(Reading& reading, Words words);
void follow_boundary(Reading& reading, Words words);
void follow_create_box(Reading& reading, Words words);
void follow_lattice(Reading& reading, Words words);
void follow_timestep(Reading& reading, Words words);
void follow_units(Reading& reading, Words words);
/// `clear`: a plan holds all that the deck does.
void refuse_clear(Reading& reading, Words words);

/// `fix ID group gravity G vector X Y Z`
void follow_gravity(Reading& reading, const Fix& fix, Words words);

}  // namespace granulaw::deck
