#pragma once

#include <string>

#include "deck/geometry.hpp"
#include "liggghts_plugin/plan/scene.hpp"

namespace granulaw::deck {

/// LIGGGHTS's own sentence of what it said, without the place in its source.
std::string complaint(const std::string& said);
/// As LIGGGHTS takes them: -in DECK -var NAME VALUE...
std::vector<std::string> words_of(const std::string& deck, const Presets& presets);

/// LIGGGHTS reads the deck (`liggghts-mpm -plan`). Throws Error where that program is missing, or with LIGGGHTS's own
/// sentence where the deck, or a file that it needs, cannot be used. `also_from_here`: its paths may count from where one stands.
Scene read_scene(const std::string& deck, const Presets& presets = {}, bool also_from_here = true);

}  // namespace granulaw::deck
