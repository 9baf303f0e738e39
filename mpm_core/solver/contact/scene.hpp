#pragma once

#include <memory>
#include <vector>

#include "solver/body/body.hpp"
#include "solver/contact/contact.hpp"

namespace granulaw {

/// What is simulated: bodies, and what keeps them from passing through each other or through planes.
template <class Body>
struct BasicScene
{
  using BodyType = Body;

  std::vector<Body> bodies;
  std::unique_ptr<BasicContact<Body>> contact;
};

/// Axisymmetric: one body above the rigid plane z = 0, or two against each other, each in its own frame
/// (contact pole at the origin, body in z >= 0: the second one is mirrored).
struct Scene : BasicScene<Body>
{
  /// Overlap: how far the centres of mass have come towards the plane, or towards each other.
  double overlap() const
  {
    double sum = 0;
    for (const Body& b : bodies) sum -= b.travel;
    return sum;
  }
  /// Speed at which they separate.
  double separation_velocity() const
  {
    double sum = 0;
    for (const Body& b : bodies) sum += b.mean_velocity();
    return sum;
  }
  /// Mass that the relative motion feels: m, or m1 m2/(m1 + m2).
  double reduced_mass() const
  {
    double inverse = 0;
    for (const Body& b : bodies) inverse += 1 / b.mass;
    return 1 / inverse;
  }
};

}  // namespace granulaw
