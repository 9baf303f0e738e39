#pragma once

#include "solver/output/trace.hpp"
#include "solver/solid/solid.hpp"

namespace granulaw {

/// The rigid motion of a body: its mass, kg, and its tensor of inertia about the centre of mass in the frame
/// of the wall, kg m^2.
struct RigidBody
{
  double mass;
  Eigen::Matrix3d inertia;
};

/// sqrt(W_u/W_l) of an impact without spin on one plane: W_l is the energy that the contact takes from the
/// rigid motion until that is least, W_u what it gives back (Stronge 1990, Proc. R. Soc. A 431). Between 0
/// and 1 wherever the contact goes on the body; the ratio of the contact point's normal velocities where it
/// stays. The body's turn during the contact is neglected.
double energetic_restitution(const RunResult& run, const RigidBody& body, double velocity);

}  // namespace granulaw
