#pragma once

#include "law/law.hpp"

namespace granulaw {

/// How one contact of a particle code resists sliding: LIGGGHTS's `tangential history`.
struct TangentialSpring
{
  double friction = 0;  ///< Coulomb's coefficient
  /// k_t over the contact radius, Pa: 8 G*, G* = G/(2 - nu) on a rigid wall (Mindlin 1949).
  double stiffness = 0;
  double damping_ratio = 0;      ///< of the critical damping, while it sticks; the plug-in's default is 0.1
  bool computed_radius = false;  ///< k_t takes the law's contact radius, else Hertz's sqrt(R delta)
  /// Of a contact that yields: T_0 over its area, Pa. It yields where (F/F_0)^4 + (T/T_0)^4 = 1, F_0 the
  /// law's force, and flows along the normal of that curve while it deepens. 0: friction alone limits T.
  double shear_strength = 0;
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
  double force_max = 0;           ///< N, normal
  double tangential_force_max = 0;
};

/// As LIGGGHTS integrates one contact (velocity Verlet, forces at the velocities of half a step): the law's
/// normal force, and a spring k_t whose force is cut at friction times the normal force.
ObliqueAnswer replay_oblique(const BodyLaw& law, const ObliqueThrow& thrown, const TangentialSpring& spring,
                             int steps_per_contact = 20000);

}  // namespace granulaw
