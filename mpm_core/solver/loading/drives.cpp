#include "solver/loading/drives.hpp"

#include "base/state_archive.hpp"

namespace granulaw {

void BodyForce::set(Scene& scene, double speed, double)
{
  const double velocity = -speed;  // overlap grows as the bodies come nearer
  const double shift = velocity - scene.separation_velocity(), reduced = scene.reduced_mass();
  for (Body& body : scene.bodies) add_velocity(body, shift * reduced / body.mass() * scene.outward);
  work_ += shift * reduced * 0.5 * (velocity_ + velocity);
  velocity_ = velocity;
}

Vector3 BodyForce::bulk_velocity(const Scene& scene, const Body& body, double speed) const
{
  return -speed * scene.reduced_mass() / body.mass() * scene.outward;
}

void BodyForce::visit_state(StateArchive& a)
{
  a.value(work_), a.value(velocity_);
}

void EquatorPlane::set(Scene& scene, double speed, double dt)
{
  Body& body = scene.bodies.front();
  const double velocity = -speed, gain = velocity - velocity_;
  add_velocity(body, gain * scene.outward);
  for (const int i : body.reference().equator) {
    double& v = body.v_i(i, 1);
    work_ += body.reference().mass_i[i] * (velocity - v) * 0.5 * (velocity_ + velocity);
    v = velocity;
  }
  const double mean = scene.separation_velocity();
  work_ += gain * body.mass() * 0.5 * (mean_ + mean);
  mean_ = mean;
  driven_ += dt * velocity;
  velocity_ = velocity;
}

Vector3 EquatorPlane::bulk_velocity(const Scene& scene, const Body&, double speed) const
{
  return -speed * scene.outward;
}

void EquatorPlane::visit_state(StateArchive& a)
{
  a.value(work_), a.value(velocity_), a.value(mean_), a.value(driven_);
}

void MovingPlanes::lead(Scene& scene, double speed)
{
  std::vector<Plane>& planes = scene.planes->planes();
  for (std::size_t k = 0; k < planes.size(); ++k) planes[k].velocity = speed * speeds_[k];
}

bool MovingPlanes::touches(const Scene& scene, bool) const
{
  for (std::size_t k = 0; k < speeds_.size(); ++k)
    if (speeds_[k] != 0 && scene.planes->acts(static_cast<int>(k))) return true;
  return false;
}

void MovingPlanes::visit_state(StateArchive& a)
{
  a.value(driven_);
}

}  // namespace granulaw
