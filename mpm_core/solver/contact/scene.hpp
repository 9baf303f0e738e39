#pragma once

#include <memory>
#include <vector>

#include "solver/body/motion.hpp"
#include "solver/contact/contact.hpp"

namespace granulaw {

class Parallel;
class Planes;

/// A simulation's bodies, and what keeps them from passing through each other or through planes.
///
/// Axisymmetric: one body above the rigid plane z = 0, or two against each other, each in its own frame
/// (contact pole at the origin, body in z >= 0: the second one is mirrored). Three dimensions: one body among
/// rigid planes, or two spheres, the second one mirrored in z, too. Or a packing of spheres in one frame, for
/// which `outward`, `centre` and what follows from them mean nothing.
struct Scene
{
  std::vector<Body> bodies;
  std::unique_ptr<Contact> contact;
  Planes* planes = nullptr;            ///< three dimensions: the contact's side
  Parallel* threads = nullptr;         ///< share the bodies; null: there are none
  Vector3 outward = Vector3::UnitZ();  ///< in each body's frame, away from what it meets first
  Vector3 centre = Vector3::Zero();    ///< three dimensions: centre of mass of the undeformed body

  /// Three dimensions: the first body among planes, or against the second.
  void meet(std::unique_ptr<Planes> planes, std::unique_ptr<Pull> pull = nullptr);
  void meet(std::unique_ptr<Side> side, std::unique_ptr<Pull> pull = nullptr);

  /// Centre of mass of the first body now.
  Vector3 centre_now() const { return centre + travel_of(bodies.front()); }
  /// Overlap: how far the centres of mass have come towards the plane, or towards each other.
  double overlap() const
  {
    double sum = 0;
    for (const Body& b : bodies) sum -= outward.dot(travel_of(b));
    return sum;
  }
  /// Speed at which they separate.
  double separation_velocity() const
  {
    double sum = 0;
    for (const Body& b : bodies) sum += outward.dot(mean_velocity(b));
    return sum;
  }
  /// Mass of the relative motion: m, or m1 m2/(m1 + m2).
  double reduced_mass() const
  {
    double inverse = 0;
    for (const Body& b : bodies) inverse += 1 / b.mass();
    return 1 / inverse;
  }
};

}  // namespace granulaw
