#pragma once

#include "law/law.hpp"
#include "yielding_contact.hpp"

namespace granulaw {

/// Resistance to sliding of one contact of a particle code: LIGGGHTS's `tangential history`.
struct TangentialSpring
{
  double friction = 0;  ///< Coulomb's coefficient
  /// k_t over the contact radius, Pa: 8 G*, G* = G/(2 - nu) on a rigid wall (Mindlin 1949).
  double stiffness = 0;
  double damping_ratio = 0;      ///< of the critical damping, while it sticks; the plug-in's default is 0.1
  bool computed_radius = false;  ///< k_t takes the law's contact radius, else Hertz's sqrt(R delta)
};

/// A sphere thrown at a rigid wall without spin. Signs as of `mpm impact`: tangential along the velocity
/// before, spin positive as of a sphere that rolls that way.
struct ObliqueThrow
{
  double radius, mass, velocity, tangential_velocity;  ///< m, kg, m/s, m/s
};

struct ObliqueAnswer
{
  double restitution = 0;         ///< of the normal velocity
  double tangential = 0;          ///< m/s, of the centre after
  double spin = 0;                ///< rad/s after
  double impulse_normal = 0;      ///< N s
  double impulse_tangential = 0;  ///< N s, against the tangential velocity
};

/// As LIGGGHTS integrates one contact (velocity Verlet, forces at the velocities of half a step): the law's
/// normal force, and a spring k_t whose force is cut at friction times the normal force.
ObliqueAnswer replay_spring(const BodyLaw& law, const ObliqueThrow& thrown, const TangentialSpring& spring,
                            int steps_per_contact = 20000);

/// The same with a YieldingContact; of `spring` its friction and stiffness.
ObliqueAnswer replay_yielding(const BodyLaw& law, const ObliqueThrow& thrown, const TangentialSpring& spring,
                              const FlowStress& material, int steps_per_contact = 20000);

}  // namespace granulaw
