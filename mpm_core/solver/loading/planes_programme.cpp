#include "solver/loading/planes_programme.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace granulaw {

namespace {

// As in a press onto one plane (loading_programme.cpp).
constexpr double hold_time = 6.0, hold_damping = 1.5;
/// Part of the unloading's time in which it reaches its speed.
constexpr double start_share = 0.4;

double most_damping(const SpatialScene& scene, double velocity)
{
  double rate = hold_damping;
  for (const SpatialRegion& region : scene.bodies.front().regions)
    if (region.moduli.yields)
      rate = std::min(rate, 0.01 * region.moduli.yield / std::max(std::abs(velocity), 1e-300));
  return rate;
}

}  // namespace

double PlanesProgramme::target_velocity(double time) const
{
  const double t = time - start_;
  if (phase_ == Phase::load)
    return plan_.depth * M_PI / (2 * plan_.ramp) * std::sin(M_PI * std::clamp(t / plan_.ramp, 0.0, 1.0));
  if (phase_ == Phase::hold) return 0;
  const double s = std::min(1.0, t / (start_share * plan_.unload_ramp));
  return -speed_ * s * s * (3 - 2 * s);
}

/// A plane that stands still may hold the body for good: the walls of a die do.
bool PlanesProgramme::moving_planes_push(const SpatialContact& contact) const
{
  for (std::size_t k = 0; k < plan_.speeds.size(); ++k)
    if (plan_.speeds[k] != 0 && contact.pushes(static_cast<int>(k))) return true;
  return false;
}

/// Takes `share` of every velocity relative to the centre of mass out of the body.
void PlanesProgramme::damp(SpatialScene& scene, double share)
{
  SpatialBody& body = scene.bodies.front();
  const Vector3 mean = mean_velocity(body);
  const double before = body.kinetic_energy();
  for (int i = 0; i < body.nodes; ++i)
    for (int d = 0; d < 3; ++d)
      if (body.inverse_mass_i[4 * i + d] > 0) body.v_i[4 * i + d] -= share * (body.v_i[4 * i + d] - mean[d]);
  damping_ += body.kinetic_energy() - before;
}

void PlanesProgramme::lead(SpatialScene& scene, double time, double dt)
{
  velocity_ = target_velocity(time + 0.5 * dt);
  auto& planes = static_cast<SpatialContact&>(*scene.contact).planes();
  for (std::size_t k = 0; k < planes.size(); ++k) planes[k].velocity = velocity_ * plan_.speeds[k];
}

void PlanesProgramme::apply(SpatialScene& scene, double time, double dt, bool)
{
  auto& contact = static_cast<SpatialContact&>(*scene.contact);
  delta_ += dt * velocity_;  // the planes moved with it in this step's contact
  now_ = time + dt;
  if (moving_planes_push(contact)) last_touch_ = now_;
  switch (phase_) {
    case Phase::load: {
      const double t = (now_ - start_) / plan_.ramp;
      const double slowness = t > 0.5 ? 1 - std::sin(M_PI * std::min(1.0, t)) : 0;
      const double rate = hold_damping * std::pow(slowness, 4);
      if (rate > 0) damp(scene, std::min(rate, most_damping(scene, velocity_)) * dt);
      if (t >= 1) phase_ = Phase::hold, start_ = now_;
      break;
    }
    case Phase::hold:
      damp(scene, hold_damping * dt);
      if (now_ - start_ >= hold_time) {
        phase_ = Phase::unload;
        start_ = last_touch_ = now_;
        work_load_ = contact.work();
        // elastic spring-back of a contact of radius a: between F/(2 E* a) (flat punch) and 1.5 times that
        speed_ = std::max(1e-6, 1.5 * force_ / (2 * std::max(radius_, 1e-6))) / plan_.unload_ramp;
      }
      break;
    case Phase::unload:
      finished_ = now_ - last_touch_ > leaving_time || delta_ < -0.5 * plan_.depth;
      break;
  }
  work_ = contact.work() + damping_;
}

double PlanesProgramme::progress() const
{
  const double whole = plan_.ramp + hold_time + plan_.unload_ramp;
  const double before = phase_ == Phase::load   ? 0
                        : phase_ == Phase::hold ? plan_.ramp
                                                : plan_.ramp + hold_time;
  return std::min(1.0, (before + now_ - start_) / whole);
}

void PlanesProgramme::visit_state(StateArchive& a)
{
  a.value(phase_);
  for (double* x : {&start_, &speed_, &delta_, &velocity_, &last_touch_, &now_, &force_, &radius_, &work_,
                    &damping_, &work_load_})
    a.value(*x);
  a.value(finished_);
}

}  // namespace granulaw
