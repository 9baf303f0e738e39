#pragma once

#include "solver/output/trace.hpp"
#include "solver/contact/scene.hpp"
#include "solver/body/spatial_motion.hpp"

namespace granulaw {

/// One three-dimensional body among rigid planes.
struct SpatialScene : BasicScene<SpatialBody>
{
  /// Normal of the first plane, away from it.
  Vector3 normal = Vector3::UnitZ();

  Vector3 centre = Vector3::Zero();  ///< centre of mass of the undeformed body

  /// Adds what each plane did over a sample of length `time`.
  void end_sample(double time, std::vector<PlaneTrace>& planes);

  /// How far the centre of mass has come towards the first plane.
  double overlap() const
  {
    const SpatialBody& body = bodies.front();
    return -(normal[0] * body.travel[0] + normal[1] * body.travel[1] + normal[2] * body.travel[2]);
  }
  /// Speed at which it leaves that plane.
  double separation_velocity() const { return normal.dot(mean_velocity(bodies.front())); }
};

}  // namespace granulaw
