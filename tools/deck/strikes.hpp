#pragma once

#include <map>
#include <string>
#include <vector>

#include "deck/meeting.hpp"
#include "deck/speeds.hpp"

namespace granulaw::deck {

/// The smallest or the largest sphere of an atom type.
struct Body
{
  const AtomType* type = nullptr;
  double radius = 0, mass = 0;  ///< m, kg
  bool is_single = false;       ///< the deck has one particle of its type
};

/// Fastest approach of two bodies.
struct Approach
{
  double speed = 0;   ///< m/s
  std::string basis;  ///< "fall", "strike", "slip" or "given"
};

/// A head-on collision of this mass, kg, and speed, m/s, presses a contact as far as others' energy does. No mass:
/// nothing presses it.
struct Load
{
  double mass = 0, speed = 0;
  double energy() const { return 0.5 * mass * speed * speed; }
};

/// Bounds on what bodies of a deck hand on to each other, by momentum and energy.
///
/// Speeds. A body comes down at v (SpeedBound). A wall turns it round with its e, one that comes at U with e v +
/// (1 + e) U, and in a box that is shaken sideways hits follow each other; a curved wall may turn it with less loss
/// (kept_in_a_turn). A heavier body M that comes at V strikes it:
/// it leaves at (1 + e) M/(M + m) (V + v) - v. Two bodies meet where one of them was turned round.
///
/// Energies. A light body between a heavy one and a wall, or two heavy ones, takes the energy of their approach in
/// its two contacts, which have one force. Two light ones that touch lie in two layers on a wall: the heavy one's cap
/// that has sunk to the second layer's centres, 3 r high, presses on 6 R/r columns of them.
class Strikes
{
 public:
  /// Keeps references to all. `deformable`: types of the deformable walls.
  Strikes(const SpeedBound& speeds, const Scene& scene, const std::map<int, AtomType>& types, const std::map<int, AtomType>& deformable, const PlanOptions& options);

  /// Smallest and largest of a type; one where they are equal.
  std::vector<const Body*> bodies(int type) const;

  Approach between(const Body& a, const Body& b) const;
  /// The fastest to one of these walls.
  Approach to(const std::vector<const Wall*>& walls, const Body& a) const;

  /// Load of the contact of two bodies.
  Load load_between(const Body& a, const Body& b) const;
  /// Load of the contact of a body with these walls.
  Load load_at(const std::vector<const Wall*>& walls, const Body& a) const;
  /// m/s, of a body that slips out from between a heavier one and a wall, with all the elastic energy of its contacts.
  /// 0: nothing is heavier. Approaches to walls count it, those of two bodies do not.
  double slip_speed(const Body& a) const;

 private:
  struct State
  {
    double direct = 0, turned = 0;  ///< m/s: as it comes down or was struck; after a wall has turned it
    bool is_struck = false;
  };
  using States = std::map<const Body*, State>;

  const States& states_at(double height) const;
  double shaken(const Body& body) const;
  State free_state(const Body& body, double height) const;
  void strike(State& light, const Body& a, const State& heavy, const Body& b) const;
  double before_any_wall(const Body& a, const Body& b) const;
  double turned_by_impact(const Body& body, double speed) const;
  double turned(const Body& body, double speed) const;
  double rebound(const Body& body, double speed) const;
  double kept_in_a_turn(const Body& body) const;
  Meeting at_wall(const Body& body, const Wall& wall) const;
  Load caught(const Body& heavy, const Body& light, const Body* other, const Wall* wall, bool at_backing) const;
  std::vector<const Body*> heavier_than(const Body& body) const;

  const SpeedBound& speeds_;
  const Scene& scene_;
  const std::map<int, AtomType>& deformable_;
  const PlanOptions& options_;
  std::vector<Body> bodies_;  ///< the heaviest first
  bool has_slopes_ = false;
  mutable std::map<double, States> states_;  ///< by height
  mutable std::map<const Body*, double> slips_;
};

}  // namespace granulaw::deck
