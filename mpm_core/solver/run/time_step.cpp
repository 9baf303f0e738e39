#include "solver/run/time_step.hpp"

#include "base/parallel.hpp"
#include "solver/body/kernels.hpp"

namespace granulaw {

namespace {

/// Stress at the points, from it the force on every node (`updated`: masses and velocities, too).
void points_to_grid(Body& body)
{
  kernels(body).points_to_grid(body);
}

/// v += kick f/m; the axis and mirrors hold their nodes (1/m is 0 there).
void accelerate(Body& body, double kick)
{
  kernels(body).accelerate(body, kick);
}

/// u += dt v; the points follow.
void grid_to_points(Body& body, double dt)
{
  const Vector3 way = dt * mean_velocity(body);
  for (int d = 0; d < 3; ++d) body.travel[d] += way[d];
  kernels(body).grid_to_points(body, dt);
}

template <class Verb>
void each_body(Scene& scene, Verb verb)
{
  if (scene.threads)
    return scene.threads->each(static_cast<int>(scene.bodies.size()),
                               [&](int b, int) { verb(scene.bodies[b]); });
  for (Body& body : scene.bodies) verb(body);
}

}  // namespace

double advance(Scene& scene, Programme& programme, double time, double kick, double dt)
{
  each_body(scene, [&](Body& body) {
    points_to_grid(body);
    accelerate(body, kick);
  });
  programme.lead(scene, time, dt);                                        // planes get their velocity
  const double impulse = scene.contact->correct(scene.bodies, kick, dt);  // nothing ends the step behind one
  programme.apply(scene, time, dt, impulse != 0);  // throws, presses, damps; then the overlap does not drift
  scene.contact->account(scene.bodies);           // energy of the contact, with the final velocities
  each_body(scene, [&](Body& body) { grid_to_points(body, dt); });
  return impulse;
}

}  // namespace granulaw
