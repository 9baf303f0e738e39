#include "solver/loading/loading_programme.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "solver/contact/spatial_scene.hpp"

namespace granulaw {

namespace {

double smooth_step(double t)
{
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// At a reversal of the press the body is held and its vibration (slowest mode: period about 2.6 R/c) damped
/// out at about critical rate. Without it e at 0.02 R would still depend on the ramp: .5845, .5877, .5890 for
/// 40, 80, 160.
constexpr double hold_time = 6.0, hold_damping = 1.5;

/// Damping already begins while the press slows down. Where material flows that is a body force of about
/// rho rate v, over R a stress; it must stay small beside the yield stress: at 1 % of it two ramps agree in F
/// to 0.1 %, without a bound they differed by 0.3 % at E*/Y = 1000 and 0.8 % at 5000 (press to 0.1 R, and F
/// at the reversal was 0.7 % and 1.7 % high).
double most_damping(const Scene& scene, double velocity)
{
  double rate = hold_damping;
  for (const Body& body : scene.bodies)
    for (const Region& region : body.regions)
      if (region.moduli.yields)
        rate = std::min(rate, 0.01 * region.moduli.yield / std::max(std::abs(velocity), 1e-300));
  return rate;
}

}  // namespace

template <class Scene>
void FreeFlight<Scene>::apply(Scene& scene, double time, double dt, bool touching)
{
  time_ = time + dt;
  if (touching) last_touch_ = time_;
  if (scene.separation_velocity() > 0) rebounding_ = true;
  finished_ = rebounding_ && time_ - last_touch_ > leaving_time;
}

template <class Scene>
double FreeFlight<Scene>::progress() const
{
  return std::min(1.0, time_ / expected_);
}

template <class Scene>
void FreeFlight<Scene>::visit_state(StateArchive& a)
{
  a.value(last_touch_), a.value(time_), a.value(rebounding_), a.value(finished_);
}

template class FreeFlight<Scene>;
template class FreeFlight<SpatialScene>;

void PressProgramme::start_loading(double time, double overlap)
{
  phase_ = Phase::load;
  start_ = time;
  from_ = overlap;
  // Reloading covers a short way: give it the time an unloading gets, plus its share of virgin loading.
  const double depth = plan_.stops.back(), stop = plan_.stops[stop_];
  const double share = (stop - std::max(0.0, deepest_)) / depth;
  duration_ = deepest_ > 0 ? plan_.unload_ramp + plan_.ramp * share : plan_.ramp * std::sqrt(stop / depth);
  reached_new_depth_ = deepest_ == 0;
}

void PressProgramme::start_holding(double time)
{
  phase_ = Phase::hold;
  start_ = time;
}

void PressProgramme::start_unloading(double time)
{
  phase_ = Phase::unload;
  ++segment_;
  start_ = last_touch_ = time;
  // Elastic spring-back of a contact of radius a: between F/(2 E* a) (flat punch) and 1.5 times that (Hertz).
  speed_ = 1.5 * force_ / (2 * e_star_ * std::max(radius_, 1e-6)) / plan_.unload_ramp;
}

double PressProgramme::target_velocity(double time) const
{
  const double t = time - start_;
  switch (phase_) {
    case Phase::load: {
      const double way = plan_.stops[stop_] - from_;
      return way * M_PI / (2 * duration_) * std::sin(M_PI * std::clamp(t / duration_, 0.0, 1.0));
    }
    case Phase::hold:
      return 0;
    case Phase::unload:
      return -speed_ * smooth_step(t / (0.4 * plan_.unload_ramp));
    case Phase::stop:
      return -speed_ * (1 - smooth_step(t / (0.2 * plan_.unload_ramp)));
  }
  return 0;
}

void PressProgramme::damp(Scene& scene, double velocity, double share)
{
  const double keep = 1 - share;
  for (Body& body : scene.bodies) {
    const double own = velocity * scene.reduced_mass() / body.mass;
    double before = 0, after = 0;
    for (int i = 0; i < body.nodes; ++i) {
      const double vr = keep * body.vr_i[i], vz = own + keep * (body.vz_i[i] - own);
      before += body.mass_i[i] * (body.vr_i[i] * body.vr_i[i] + body.vz_i[i] * body.vz_i[i]);
      after += body.mass_i[i] * (vr * vr + vz * vz);
      body.vr_i[i] = vr, body.vz_i[i] = vz;
    }
    work_ += 0.5 * (after - before);
  }
}

/// Equal and opposite body forces: two bodies share the change of velocity as the inverse of their masses.
void PressProgramme::drive_bodies(Scene& scene, double velocity)
{
  const double shift = velocity - scene.separation_velocity(), reduced = scene.reduced_mass();
  for (Body& body : scene.bodies) {
    const double own = shift * reduced / body.mass;
    for (int i = 0; i < body.nodes; ++i) body.vz_i[i] += own;
  }
  work_ += shift * reduced * 0.5 * (velocity_ + velocity);
}

/// A uniform body force carries the bulk along with the equator: without it the accelerating equator would
/// have to push the half sphere's mass through the body, and the force would lag behind the overlap.
void PressProgramme::drive_equator(Body& body, double velocity, double dt)
{
  const double gain = velocity - velocity_;
  for (int i = 0; i < body.nodes; ++i) body.vz_i[i] += gain;
  for (const int i : body.equator) {
    work_ += body.mass_i[i] * (velocity - body.vz_i[i]) * 0.5 * (velocity_ + velocity);
    body.vz_i[i] = velocity;
  }
  const double mean = body.mean_velocity();
  work_ += gain * body.mass * 0.5 * (mean_ + mean);
  mean_ = mean;
  driven_ += dt * velocity;
}

/// Damps while the press slows down, notes where virgin loading begins, ends in a hold.
void PressProgramme::continue_loading(Scene& scene, double now, double dt, double depth)
{
  if (now - start_ > 0.5 * duration_) {
    const double slowness = 1 - std::sin(M_PI * std::min(1.0, (now - start_) / duration_));
    const double rate = hold_damping * slowness * slowness * slowness * slowness;
    damp(scene, velocity_, std::min(rate, most_damping(scene, velocity_)) * dt);
  }
  if (!reached_new_depth_ && depth > deepest_) {
    reached_new_depth_ = true;
    ++segment_;
  }
  if (now - start_ >= duration_) {
    deepest_ = std::max(deepest_, depth);
    start_holding(now);
  }
}

/// Until the contact is gone for long enough; or, where the force ended at once (elastic at nearly no load),
/// after two ramps.
void PressProgramme::continue_unloading(double now, double depth)
{
  if (!(now - last_touch_ > leaving_time || depth < -0.5 * deepest_)) return;
  if (stop_ + 1 == plan_.stops.size()) finished_ = true;
  phase_ = Phase::stop;
  start_ = now;
}

void PressProgramme::start_next_stop(double now, double depth)
{
  ++stop_;
  ++segment_;
  start_loading(now, depth);
}

void PressProgramme::apply(Scene& scene, double time, double dt, bool touching)
{
  if (touching) last_touch_ = time + dt;
  const double velocity = -target_velocity(time + 0.5 * dt);  // overlap grows as the bodies move down
  if (plan_.support == Support::free)
    drive_bodies(scene, velocity);
  else
    drive_equator(scene.bodies.front(), velocity, dt);
  velocity_ = velocity;

  const double now = time + dt, depth = overlap(scene);
  switch (phase_) {
    case Phase::load:
      continue_loading(scene, now, dt, depth);
      break;
    case Phase::hold:
      damp(scene, velocity_, hold_damping * dt);
      if (now - start_ >= hold_time) start_unloading(now);
      break;
    case Phase::unload:
      continue_unloading(now, depth);
      break;
    case Phase::stop:
      if (now - start_ >= 0.2 * plan_.unload_ramp && !finished_) start_next_stop(now, depth);
      break;
  }
}

Branch PressProgramme::branch() const
{
  if (phase_ == Phase::unload || phase_ == Phase::stop) return Branch::unload;
  return reached_new_depth_ ? Branch::load : Branch::reload;
}

double PressProgramme::progress() const
{
  const double stops = static_cast<double>(plan_.stops.size());
  return std::min(1.0, (static_cast<double>(stop_) + (phase_ == Phase::load ? 0.3 : 0.7)) / stops);
}

void PressProgramme::visit_state(StateArchive& a)
{
  a.expect(plan_.stops.size(), "stops of the press");
  a.value(phase_), a.value(stop_), a.value(segment_);
  for (double* x : {&start_, &from_, &duration_, &speed_, &last_touch_, &force_, &radius_, &work_, &velocity_,
                    &mean_, &driven_, &deepest_})
    a.value(*x);
  a.value(reached_new_depth_), a.value(finished_);
}

double PressProgramme::overlap(const Scene& scene) const
{
  return plan_.support == Support::free ? scene.overlap() : -driven_;
}

}  // namespace granulaw
