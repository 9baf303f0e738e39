#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deck/plan.hpp"
#include "options.hpp"

namespace granulaw {

/// The options that `mpm plan`, `mpm stretch` and `mpm table --deck` share: the deck's variables, and what the
/// deck itself does not give.
struct DeckOptions
{
  std::string materials_file;
  std::vector<std::string> materials, variables;
  std::vector<double> radius;
  double drop_height = -1, speed = -1, density = -1, particles = -1, rate = 2e6;
  std::string visited;

  /// `own_materials`: with --materials-file (mpm table has its own). `needed`: an option without which these
  /// mean nothing.
  void add_to(Options& command, bool own_materials, Option needed = Option());
  deck::Presets presets() const;
};

using deck::PlannedDeck;

/// Throws Error.
PlannedDeck plan_deck(const std::string& deck, const DeckOptions& options);
/// The same of a deck that was read.
PlannedDeck plan_scene(deck::Scene scene, const DeckOptions& options);

/// Open questions, one line each.
std::string questions_text(const deck::Plan& plan);

/// Throws Error with the first question that is left, unless it only matters for the cost.
void require_answers(const deck::Plan& plan, const std::string& deck);

/// A largest time step, s, to three digits, rounded down: it is to be pasted.
std::string step_text(double time_step);

}  // namespace granulaw
