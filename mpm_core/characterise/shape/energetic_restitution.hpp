#pragma once

#include "solver/output/trace.hpp"
#include "solver/shape/shape.hpp"

namespace granulaw {

/// The rigid motion of a body: its mass, kg, and its tensor of inertia about the centre of mass in the frame
/// of the wall, kg m^2.
struct RigidBody
{
  double mass;
  Eigen::Matrix3d inertia;
};

/// Velocity of the centre of mass, m/s, and spin, rad/s, before an impact, in the frame of the wall (z away
/// from it).
struct RigidMotion
{
  Vector3 velocity = Vector3::Zero(), spin = Vector3::Zero();
};

/// Work of the normal force of one plane on the rigid motion (Stronge 1990, Proc. R. Soc. A 431), J.
struct ContactWork
{
  double taken = 0;       ///< W_l, until it is largest: the contact point then has no approach
  double given_back = 0;  ///< W_u, from there on
  int contacts = 1;       ///< that follow each other; the works are those of the first
  Vector3 velocity_after = Vector3::Zero();  ///< of the centre of mass, m/s, after all of them

  /// sqrt(W_u/W_l), e of the contact. Between 0 and 1 wherever the contact goes on the body; the ratio of the
  /// contact point's normal velocities where it stays. Of a sphere the ratio of the centre's.
  double restitution() const;
};

/// The body's turn during the contact is neglected.
ContactWork contact_work(const RunResult& run, const RigidBody& body, const RigidMotion& before);

/// e of the contact of a body without spin that is thrown straight at the plane.
double energetic_restitution(const RunResult& run, const RigidBody& body, double velocity);

}  // namespace granulaw
