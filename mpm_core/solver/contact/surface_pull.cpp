#include "solver/contact/surface_pull.hpp"

#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

/// Velocity of a marker, less what the nodes' forces added over `kick`.
Vector3 velocity(const Body& body, int marker, double kick)
{
  const Reference& reference = body.reference();
  const Markers& surface = reference.surface;
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < surface.corners; ++k) {
    const int i = surface.node(marker, k);
    for (const int c : {0, 1})
      sum[2 * c] += surface.weights(marker)[k] * (body.v_i(i, c) - kick * reference.inverse_mass_i(i, c) * body.f_i(i, c));
  }
  return sum;
}

/// Adds a force to the nodes that carry a marker, `share` of it.
void push_marker(Body& body, int marker, double share, const Vector3& force, double kick)
{
  const Reference& reference = body.reference();
  const Markers& surface = reference.surface;
  for (int k = 0; k < surface.corners; ++k) {
    const int i = surface.node(marker, k);
    for (const int c : {0, 1}) {
      const double f = share * surface.weights(marker)[k] * force[2 * c];
      body.f_i(i, c) += f;
      body.v_i(i, c) += kick * reference.inverse_mass_i(i, c) * f;
    }
  }
}

}  // namespace

SurfacePull::SurfacePull(const Attraction& attraction, std::span<const Body> bodies) : attraction_(attraction)
{
  pulled_.reserve(static_cast<std::size_t>(bodies.front().reference().surface.count));
}

double SurfacePull::separation(std::span<const Body> bodies, const Pulled& point, double kick)
{
  const Opposite::Place& across = point.across;
  const Vector3 near = velocity(bodies[0], point.marker, kick);
  if (bodies.size() < 2) return near[2];
  const Vector3 far = (1 - across.t) * velocity(bodies[1], across.segment, kick) + across.t * velocity(bodies[1], across.segment + 1, kick);
  return near[2] + far[2] + across.slope * (near[0] - far[0]);
}

void SurfacePull::push(std::span<Body> bodies, const Pulled& point, double force, double kick)
{
  const Opposite::Place& across = point.across;
  push_marker(bodies[0], point.marker, 1, {force * across.slope, 0, force}, kick);
  if (bodies.size() < 2) return;
  const Vector3 mirrored(-force * across.slope, 0, force);
  push_marker(bodies[1], across.segment, 1 - across.t, mirrored, kick);
  push_marker(bodies[1], across.segment + 1, across.t, mirrored, kick);
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
  for (const Pulled& p : pulled_) push(bodies, p, p.impulse / kick, kick), total += p.impulse;
  return total;
}

void SurfacePull::account(std::span<const Body> bodies)
{
  for (const Pulled& p : pulled_) taken_ -= 0.5 * p.impulse * (p.before + separation(bodies, p, 0));
}

}  // namespace granulaw
