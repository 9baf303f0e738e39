#include "solver/loading/flight.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "base/state_archive.hpp"

namespace granulaw {

void Flight::apply(Scene& scene, double time, double dt, bool touching)
{
  const double speed = leaving_speed(scene);
  overlap_ -= dt * speed;
  time_ = time + dt;
  if (touching) last_touch_ = time_;
  if (speed > 0) rebounding_ = true;
  sticks_ = attracted_ && rebounding_ && touching && speed < 0;
  finished_ = sticks_ || (rebounding_ && time_ - last_touch_ > leaving_time);
}

double Flight::leaving_speed(const Scene& scene) const
{
  if (!point_) return scene.separation_velocity();
  const Body& body = scene.bodies.front();
  const Vector3 spin = point_->inverse_inertia * of_whole(body, angular_momentum(body, scene.centre_now()));
  return scene.outward.dot(mean_velocity(body) + spin.cross(point_->arm));
}

double Flight::progress() const
{
  return std::min(1.0, time_ / expected_);
}

void Flight::visit_state(StateArchive& a)
{
  a.value(overlap_), a.value(last_touch_), a.value(time_), a.value(rebounding_), a.value(finished_);
}

}  // namespace granulaw
