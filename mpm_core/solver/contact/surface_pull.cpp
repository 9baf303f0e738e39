#include "solver/contact/surface_pull.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

SurfacePull::SurfacePull(const Attraction& attraction, std::span<const Body> bodies) : attraction_(attraction)
{
  pulled_.reserve(static_cast<std::size_t>(bodies.front().reference().surface.count));
}

double SurfacePull::separation(std::span<const Body> bodies, const Pulled& point, double kick)
{
  const Opposite::Place& across = point.across;
  const Vector3 near = velocity_before(bodies[0], point.marker, kick);
  if (bodies.size() < 2) return near[2];
  const Vector3 far = (1 - across.t) * velocity_before(bodies[1], across.segment, kick) + across.t * velocity_before(bodies[1], across.segment + 1, kick);
  return near[2] + far[2] + across.slope * (near[0] - far[0]);
}

void SurfacePull::push(std::span<Body> bodies, const Pulled& point, double kick)
{
  const Opposite::Place& across = point.across;
  const double along = point.impulse * across.slope;
  push_marker(bodies[0], point.marker, {along, 0, point.impulse}, kick);
  if (bodies.size() < 2) return;
  const Vector3 mirrored(-along, 0, point.impulse);
  push_marker(bodies[1], across.segment, (1 - across.t) * mirrored, kick);
  push_marker(bodies[1], across.segment + 1, across.t * mirrored, kick);
}

double SurfacePull::pull(std::span<Body> bodies, double kick)
{
  const Body& upper = bodies.front();
  const int count = upper.reference().surface.count;
  pulled_.clear();
  Opposite opposite(bodies);
  SurfaceMotion x = surface_motion(upper, 0);
  double inner = 0;
  for (int m = 0; m + 1 < count; ++m) {
    const SurfaceMotion next = surface_motion(upper, m + 1);
    const double outer = 0.5 * (x.r + next.r), area = M_PI * (outer * outer - inner * inner);
    Opposite::Place across;
    if (opposite.find(x, across) && across.gap < attraction_.range) {
      Pulled point{m, across, -kick * attraction_.traction(across.gap) * area, 0};
      point.before = separation(bodies, point, kick);
      pulled_.push_back(point);
    }
    inner = outer, x = next;
  }
  double total = 0;
  for (const Pulled& p : pulled_) push(bodies, p, kick), total += p.impulse;
  return total;
}

void SurfacePull::account(std::span<const Body> bodies)
{
  for (const Pulled& p : pulled_) taken_ -= 0.5 * p.impulse * (p.before + separation(bodies, p, 0));
}

}  // namespace granulaw
