#pragma once

#include "deck/commands/handlers.hpp"

namespace granulaw::deck {

/// `read_data FILE` of atom_style granular: box, sections Atoms and Velocities. Throws Error where the file
/// cannot be used.
void follow_read_data(Reading& reading, Words words);
/// `read_restart FILE`: binary, its particles are not known.
void follow_read_restart(Reading& reading, Words words);

}  // namespace granulaw::deck
