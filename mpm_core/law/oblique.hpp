#pragma once

#include <cmath>
#include <limits>

#include "contact/pair.hpp"
#include "contact/plastic_shear.hpp"
#include "law/law.hpp"

namespace granulaw {

/// Second sphere of an impact; as made, the rigid wall.
struct ObliquePartner
{
  double radius = std::numeric_limits<double>::infinity();  ///< m
  double mass = std::numeric_limits<double>::infinity();    ///< kg
  ElasticBody body{};
};

/// A sphere thrown without spin at a rigid wall, or at a sphere at rest. Tangential: along the velocity before; spin
/// positive as of a sphere that rolls that way. Velocities are relative.
struct ObliqueThrow
{
  double radius, mass, velocity, tangential_velocity;  ///< m, kg, m/s (normal, approach), m/s
  ObliquePartner partner{};

  bool at_wall() const { return std::isinf(partner.radius); }
  double r_eff() const { return at_wall() ? radius : effective_radius(radius, partner.radius); }
  double m_eff() const { return at_wall() ? mass : effective_mass(mass, partner.mass); }
};

struct ObliqueAnswer
{
  double restitution = 0;         ///< of the velocity along the normal of first touch
  double tangential = 0;          ///< m/s, of the centre after
  double spin = 0;                ///< rad/s after
  double partner_spin = 0;        ///< the same of a second sphere
  double impulse_normal = 0;      ///< N s
  double impulse_tangential = 0;  ///< N s, against the tangential velocity
  double overlap_max = 0;         ///< m
  double dissipated = 0;          ///< J, of the ledger
};

/// Tangential laws of a particle code.
enum class TangentialKind {
  history,  ///< LIGGGHTS's: Mindlin's spring, cut at friction times the normal force
  plastic   ///< PlasticShear
};

/// An oblique impact by a pair's law, as LIGGGHTS integrates one contact: velocity Verlet, forces at the velocities
/// of half a step. The thrown sphere is the yielding body of the law. `friction`: Coulomb's coefficient; `damping_ratio`: of the
/// spring, part of critical, in `plastic` of contacts that never yielded; `steps`: in Hertz's contact time. Throws
/// Error where the impact leaves the law's overlaps or speeds.
ObliqueAnswer replay_oblique(const PairLaw& pair, const ObliqueThrow& thrown, TangentialKind kind, double friction,
                             double damping_ratio, int steps = 2000);

}  // namespace granulaw
