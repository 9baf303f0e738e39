#pragma once

#include "base/attraction.hpp"
#include "solver/contact/planes.hpp"

namespace granulaw {

/// Attraction between rigid planes and the surface of a body in three dimensions: of each patch sigma_0 (1 - g/h_0) times its area now,
/// projected on the plane; g is the gap of its marker.
class PlanePull : public Pull
{
 public:
  /// `attraction`: in units of the run. `patches`: of each marker the outward normal times the area at rest.
  PlanePull(Planes& planes, const Body& body, const Attraction& attraction, std::vector<Vector3> patches);
  double pull(std::span<Body> bodies, double kick) override;
  void account(std::span<const Body> bodies) override;

 private:
  struct Pulled
  {
    int plane, marker;
    Vector3 place;
    double impulse, before;  ///< along the plane's normal; velocity at the start of the step
  };
  double area_now(const Body& body, int marker, const Vector3& normal) const;

  Planes* planes_;
  Attraction attraction_;
  std::vector<Vector3> patches_;
  std::vector<Pulled> pulled_;  // in this step
};

}  // namespace granulaw
