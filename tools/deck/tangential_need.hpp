#pragma once

#include <string>

#include "deck/plan.hpp"

namespace granulaw::deck {

/// Which tangential law the deck needs (docs/guide/tangential.md), and why.
struct TangentialNeed
{
  const PairPlan* pair = nullptr;  ///< that needs `tangential plastic` most; null: none does
  double friction = 0;             ///< of that pair
  double sticking = 0;             ///< part of its random collisions that stick
  std::string reason;              ///< one clause
};

/// The part of random collisions of spheres without spin that stick at some time: a contact slides all through where the
/// tangent of the angle from the normal exceeds 7/2 mu (1 + e); angles of random collisions have the density sin(2 angle).
double sticking_part(double friction, double restitution);

TangentialNeed tangential_need(const Scene& scene, const Plan& plan);

}  // namespace granulaw::deck
