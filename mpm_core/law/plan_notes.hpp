#pragma once

#include <string>

#include "law/law.hpp"

namespace granulaw {

/// Notes in a law's provenance: what it was made for, so that a simulation that leaves it can say so.
inline constexpr const char *command_note = "command", *depth_note = "depth", *deck_note = "deck";

/// Largest overlap over R*, of the real contact, and speed, m/s, that were planned for a pair of a deck. Of several
/// the largest overlap stays.
void note_planned(Law& law, const std::string& a, const std::string& b, double overlap, double speed);

/// "planned for DECK: d/R* 0.0252 at 3.33 m/s", the overlap times `stretch`; empty: the law was made for no deck.
std::string planned_text(const Law& law, const std::string& a, const std::string& b, double stretch);

/// Remedy that holds this overlap of a pair, and the planned one, beyond the end of its table: the `mpm table` line, or why
/// none does. `overlap`, `end`: over R*, of the real contact; `table_end`: the end over lambda R*.
std::string remedy_beyond(const Law& law, const std::string& a, const std::string& b, double overlap, double end, double table_end);

}  // namespace granulaw
