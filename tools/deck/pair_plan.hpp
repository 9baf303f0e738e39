#pragma once

#include <optional>
#include <string>

#include "deck/meeting.hpp"
#include "deck/strikes.hpp"
#include "deck/visited.hpp"

namespace granulaw::deck {

struct PlanOptions;

/// Requirements of one pair of the simulation.
struct PairPlan
{
  Meeting meeting;
  double speed = 0;           ///< m/s, largest approach speed
  std::string speed_basis;    ///< Approach::basis (deck/strikes.hpp), or "visited"
  double onset = 0;           ///< m/s, where yield begins, the least over the sizes; infinity: never
  double yield_velocity = 0;  ///< m/s, customary V_y, the least over the sizes; infinity: elastic
  double damage_number = 0;   ///< largest I = rho V^2/Y (law/damage_number.hpp)
  double axis_number = 0;     ///< v^2 of the velocity axis (contact/axis.hpp): I of the pair's one body
  double overlap = 0;         ///< largest, over R*, of the real contact: the deck's over its stretch
  double depth = 0;           ///< largest, over lambda R*: the table's own coordinate
  double strain_rate = 0;     ///< 1/s, largest, of impacts that yield: dent_rate(); 0: nothing yields by impact
  std::string overlap_basis;  ///< "law", "Thornton" or "Hertz", of an impact; "pressed": by heavier bodies; "visited"
  double contact_time = 0;    ///< s, shortest: Hertz at the largest speed, smallest particles
  double time_step = 0;       ///< s, largest_step (law/contact_step.hpp) to `overlap`, unstretched; infinity: any
  bool needs_table = false;   ///< it yields; false: Hertz suffices
  bool visited = true;        ///< false: a run did not meet it
};

/// Two bodies that may meet, how fast, and what others do to their contact.
struct SizedEncounter
{
  double radius_a = 0, radius_b = 0;  ///< m; of a wall infinite
  double radius = 0, mass = 0;        ///< R*, m, and m*, kg
  Approach approach;
  Load load;
};

/// Two types that may meet, at the extremes of their sizes.
struct Encounter
{
  Meeting meeting;
  std::vector<SizedEncounter> sizes;
};

/// `stretch`: of the deck's law; what the run `visited` (null: none) replaces what is foreseen.
PairPlan plan_pair(const Encounter& encounter, const PlanOptions& options, double stretch, const Visited* visited);

}  // namespace granulaw::deck
