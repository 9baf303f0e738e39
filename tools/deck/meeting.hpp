#pragma once

#include <string>

#include "deck/atom_types.hpp"
#include "law/law.hpp"

namespace granulaw::deck {

/// Two bodies of the scene that may touch: type `a`, of particles, and type `b`, of particles or a wall.
struct Meeting
{
  int a = 1, b = 1;
  bool wall = false;           ///< b is a wall
  bool deformable = false;     ///< ... whose material gives way; else it is rigid for the normal law
  std::string name_a, name_b;  ///< of the materials; of a rigid wall "wall"
  LawMaterial yields;          ///< the body that yields first (law.hpp)
  PairMapping mapping;
  bool known_yield = false;  ///< whether the yield stress is known, be it infinite

  /// Density, kg/m^3, of the sphere of radius lambda R* and mass lambda m* that stands for the pair on a
  /// rigid wall: its damage number and its V_y are the pair's (contact/pair.hpp).
  double one_body_density(double r_eff, double m_eff) const;
};

/// Particles of two types.
Meeting meeting_of(const AtomType& a, const AtomType& b);
/// Particles and a wall of their type `wall`'s material.
Meeting meeting_with_wall(const AtomType& a, const AtomType& wall);
/// Particles and a rigid wall of this type.
Meeting meeting_with_rigid_wall(const AtomType& a, int wall_type);

/// The atom types of two bodies that meet: "1:2", "1:wall 2".
std::string types_text(const Meeting& meeting);

}  // namespace granulaw::deck
