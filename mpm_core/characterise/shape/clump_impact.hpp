#pragma once

#include <vector>

#include "characterise/shape/energetic_restitution.hpp"
#include "law/law.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

struct ClumpAnswer
{
  ContactAnswer contact;    ///< of all balls together
  bool left_range = false;  ///< an overlap went past the law's table
};

/// A rigid clump, without spin, flies into a rigid wall; every ball that touches it follows the law of a sphere of its
/// radius, as in LIGGGHTS, frictionless. `balls`: about the centre of mass; `direction`: unit vector to the wall, in the
/// frame of the balls and of `body`. `with_body`: in series with the body behind each (contact/body_behind.hpp).
ClumpAnswer clump_on_wall(const BodyLaw& law, const std::vector<ClumpBall>& balls, const RigidBody& body,
                          const Vector3& direction, double velocity, bool with_body);

}  // namespace granulaw
