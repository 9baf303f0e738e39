#pragma once

#include <optional>

#include "atlas/atlas.hpp"
#include "deck/plan_options.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

/// Makes the contacts of a plan follow the law that the deck names, where it is of the body that yields, else
/// the atlas's; of model thornton his closed form.
void set_contact_law(PlanOptions& into, const Scene& scene, std::optional<Law> deck_law, std::optional<Atlas> atlas);

}  // namespace granulaw::deck
