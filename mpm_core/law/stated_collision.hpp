#pragma once

#include "law/chosen_pair.hpp"
#include "law/pair_statement.hpp"
#include "law/replay.hpp"

namespace granulaw {

/// One head-on collision by the law, with the error that the law file states for it.
struct StatedCollision
{
  Replay replay;
  double damage_number = 0;     ///< of damage_number.hpp
  double axis_speed = 0;        ///< v of a velocity axis (PairLaw::axis_speed)
  PairStatement statement;      ///< for these sizes
  bool beyond_bound = false;    ///< the damage number is above that up to which the error bound holds
  bool needs_axis = false;      ///< ... and the law has no velocity axis

  /// False where the law's error bound does not hold: beyond its damage number, and at speeds outside its velocity
  /// axis, where the corrections of the nearest speed stand in.
  bool is_bounded() const { return !(beyond_bound || replay.left_speeds || replay.held_speed); }
  ErrorBound bound() const { return is_bounded() ? statement.bound.at(axis_speed) : ErrorBound{}; }
};

/// `velocity`: m/s, of approach, 1e-12 to 1e6. Throws Error where it is another, and, led by `source`, where the
/// collision goes deeper than the law is good for, or adhesion is refused (DentAdhesion::fault). `body`: what the first of the pair is
/// fixed to.
StatedCollision collide(const Law& law, const ChosenPair& pair, double velocity, const std::string& source,
                        const ImpactBody& body = {}, const Attraction& attraction = {});

/// The bound of such a collision alone, without its replay: of a speed at which the law has none, not stated.
ErrorBound bound_of_impact(const Law& law, const ChosenPair& pair, double velocity);

}  // namespace granulaw
