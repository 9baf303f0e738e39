#pragma once

#include "solver/contact/scene.hpp"

namespace granulaw {

template <class Scene>
class BasicProgramme;
struct SpatialBody;

/// One step of the material point method, as verbs in order, in two and in three dimensions. Velocities live
/// half a step before `time`: `kick` is half the last step plus half this one, `dt`. (With kick = dt the
/// scheme would be of first order while the step changes: at V/V_y = 1500 it shrinks fivefold, and 1e-3 of
/// the energy is lost.) Returns the impulse of the contact on the first body.
template <class Scene>
double advance(Scene& scene, BasicProgramme<Scene>& programme, double time, double kick, double dt);

/// Largest stable step 2/omega_max of the central-difference scheme.
template <class Body>
class StableStep
{
 public:
  /// omega_max of the undeformed body by power iteration on M^-1 K. The body must be undeformed and at rest.
  explicit StableStep(Body& body);
  /// The limit for the body as it is deformed now: omega_max scaled by the largest growth of any cell's own
  /// bound.
  double limit(const Body& body) const;

 private:
  double omega_ = 0, bound_ = 0;
};

template <>
StableStep<Body>::StableStep(Body& body);
template <>
double StableStep<Body>::limit(const Body& body) const;
template <>
StableStep<SpatialBody>::StableStep(SpatialBody& body);
template <>
double StableStep<SpatialBody>::limit(const SpatialBody& body) const;

}  // namespace granulaw
