#pragma once

#include "deck/plan.hpp"
#include "deck/plan_options.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

/// A deck read and planned.
struct PlannedDeck
{
  Scene scene;
  PlanOptions options;
  Plan plan;
};

}  // namespace granulaw::deck
