#pragma once

#include <string>
#include <vector>

#include "deck/pair_plan.hpp"
#include "deck/plan_options.hpp"
#include "deck/questions.hpp"
#include "deck/scene.hpp"
#include "deck/visited.hpp"

namespace granulaw::deck {

/// A bed that walls or sides of the box press.
struct Pressing
{
  double solid_volume = 0;  ///< of the spheres, over the box at its smallest; 0: not known, or nothing presses
  double overlap = 0;       ///< of each sphere over its radius, about
  double pressure = 0;      ///< over the yield stress, about
  double time_step = 0;     ///< s, largest of a particle that is pressed from all sides (docs/guide/pressing.md); 0: not known
  /// Laws of one contact end (docs/guide/pressing.md).
  bool needs_confinement() const { return solid_volume > 0.6; }
};
Pressing pressing_to(double solid_volume);

/// One sentence about it; empty: nothing presses, or it is not known how far. `confinement`: as the deck says it; empty: off.
std::string pressing_text(const Pressing& pressing, const std::string& confinement);

struct Plan
{
  std::vector<PairPlan> pairs;
  std::vector<Question> questions;
  double fall = 0;                        ///< m, largest height a particle may fall
  double radius_min = 0, radius_max = 0;  ///< m
  double mass_min = 0, mass_max = 0;      ///< kg
  /// s, the largest that the planned overlaps of all pairs allow, stretched as the deck says; 0: none meets.
  double time_step = 0;
  const PairPlan* stiffest() const;      ///< the pair that requires it; null: none meets
  double particle_steps = 0, hours = 0;  ///< not a number: they depend on the loop `unknown_cost`
  std::string unknown_cost;              ///< "FILE:LINE" of its run; empty: they are known
  std::vector<std::string> law_pairs;    ///< "a:b" that the plug-in requires of the law, in order
  double depth = 0, damage_number = 0;   ///< that the table needs, margins included; 0: no table
  bool axis_matters = false;             ///< the velocity axis
  std::vector<std::string> not_bounded;  ///< what of the scene no energy bounds
  Pressing pressing;
  bool complete() const { return questions.empty(); }
};

/// A deck read and planned.
struct PlannedDeck
{
  Scene scene;
  PlanOptions options;
  Plan plan;
};

/// Below this I inertia takes less than 1 % of e: the law needs no velocity axis
/// (docs/theory/damage-number.md).
inline constexpr double negligible_damage_number = 0.002;

/// Plans a scene: which bodies meet, how fast (deck/speeds.hpp), and what that needs of a law.
Plan make_plan(const Scene& scene, const PlanOptions& options, const Visited* visited = nullptr);

/// Notes in a law that was made for the plan's deck what it allows of each pair (law/plan_notes.hpp).
void note_plan(Law& law, const Plan& plan, const std::string& deck);

/// One sentence for each pair that the scene takes deeper or faster than any law goes; empty: none.
std::vector<std::string> beyond_laws(const Plan& plan);

/// The sizes that a law of the deck's pairs must know: the largest ratio of two spheres' radii, as far as
/// laws are made for it, and whether a body meets a deformable wall.
struct PairSizes
{
  double radius_ratio = 1;
  bool thick_walls = false;
};
PairSizes pair_sizes(const Plan& plan);

/// The words behind `mpm table` that build what the plan needs; empty: no table is needed, or it cannot be
/// said yet.
std::string table_command(const Plan& plan, const std::string& materials_file);

}  // namespace granulaw::deck
