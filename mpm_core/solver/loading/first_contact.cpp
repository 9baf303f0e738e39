#include "solver/loading/first_contact.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "base/state_archive.hpp"

namespace granulaw {

FirstContact::FirstContact(double expected_duration, const Vector3& arm, const Eigen::Matrix3d& inertia)
    : expected_(expected_duration), arm_(arm), inverse_inertia_(inertia.inverse())
{
}

void FirstContact::apply(SpatialScene& scene, double time, double dt, bool touching)
{
  const double speed = leaving_speed(scene);
  overlap_ -= dt * speed;
  time_ = time + dt;
  if (touching) last_touch_ = time_;
  if (speed > 0) rebounding_ = true;
  finished_ = rebounding_ && time_ - last_touch_ > leaving_time;
}

/// Of the point, in the rigid motion that has the body's momentum and angular momentum. The body hardly turns
/// during one contact: arm and tensor are those at its start.
double FirstContact::leaving_speed(const SpatialScene& scene) const
{
  const SpatialBody& body = scene.bodies.front();
  const Vector3 centre = scene.centre + Vector3(body.travel[0], body.travel[1], body.travel[2]);
  const Vector3 spin = inverse_inertia_ * of_whole(body, angular_momentum(body, centre));
  return scene.normal.dot(mean_velocity(body) + spin.cross(arm_));
}

double FirstContact::progress() const
{
  return std::min(1.0, time_ / expected_);
}

void FirstContact::visit_state(StateArchive& a)
{
  a.value(overlap_), a.value(last_touch_), a.value(time_), a.value(rebounding_), a.value(finished_);
}

}  // namespace granulaw
