#pragma once

#include <vector>

#include "solver/shape/shape.hpp"

namespace granulaw {

/// One way in which a body may hit a wall.
struct Orientation
{
  Vector3 direction;      ///< unit vector in the body's frame that points at the wall
  Vector3 contact;        ///< m, the body's point that touches first
  PrincipalRadii radii;   ///< there
  double effective_mass;  ///< over the body's mass (effective_mass_share)
  double height;          ///< m, of the centre of mass over the contact
};

/// Quasi-uniform directions over the part of the sphere that the body's mirror planes leave: a Fibonacci
/// lattice, equal areas in z and angle, so that each stands for the same fraction of all directions.
std::vector<Vector3> contact_directions(const Shape& solid, int count = 30);

std::vector<Orientation> orientations_of(const Shape& solid, int count = 30);

/// Mass that resists a normal impulse at a point, over the body's mass: 1/m_eff = 1/m + (r x n).I^-1 (r x n),
/// r from the centre of mass to the contact. 1 where the normal passes through the centre of mass.
double effective_mass_share(const MassProperties& mass, const Vector3& contact, const Vector3& normal);

}  // namespace granulaw
