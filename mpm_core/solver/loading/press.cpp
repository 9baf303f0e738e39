#include "solver/loading/press.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

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
double most_damping(const Scene& scene, double speed)
{
  double rate = hold_damping;
  for (const Body& body : scene.bodies)
    for (const Region& region : body.reference().regions)
      if (region.moduli.yields)
        rate = std::min(rate, 0.01 * region.moduli.yield / std::max(std::abs(speed), 1e-300));
  return rate;
}

}  // namespace

void Press::start_loading(double time, double overlap)
{
  phase_ = Phase::load;
  start_ = time;
  from_ = overlap;
  // Reloading covers a short way: give it the time an unloading gets, plus its part of virgin loading.
  const double depth = plan_.stops.back(), stop = plan_.stops[stop_];
  const double share = (stop - std::max(0.0, deepest_)) / depth;
  duration_ = deepest_ > 0 ? plan_.unload_ramp + plan_.ramp * share : plan_.ramp * std::sqrt(stop / depth);
  reached_new_depth_ = deepest_ == 0;
}

void Press::start_unloading(double time)
{
  phase_ = Phase::unload;
  ++segment_;
  start_ = last_touch_ = time;
  work_at_unload_ = work_;
  // Elastic spring-back of a contact of radius a: between F/(2 E* a) (flat punch) and 1.5 times that (Hertz).
  unload_speed_ = 1.5 * force_ / (2 * e_star_ * std::max(radius_, 1e-6)) / plan_.unload_ramp;
}

double Press::target_speed(double time) const
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
      return -unload_speed_ * smooth_step(t / (0.4 * plan_.unload_ramp));
    case Phase::stop:
      return -unload_speed_ * (1 - smooth_step(t / (0.2 * plan_.unload_ramp)));
  }
  return 0;
}

void Press::damp(Scene& scene, double share)
{
  for (Body& body : scene.bodies)
    damping_ += damp_velocity(body, drive_->bulk_velocity(scene, body, speed_), share);
}

/// Damps while the press slows down, notes where virgin loading begins, ends in a hold.
void Press::continue_loading(Scene& scene, double dt, double depth)
{
  if (now_ - start_ > 0.5 * duration_) {
    const double slowness = 1 - std::sin(M_PI * std::min(1.0, (now_ - start_) / duration_));
    const double rate = hold_damping * slowness * slowness * slowness * slowness;
    damp(scene, std::min(rate, most_damping(scene, speed_)) * dt);
  }
  if (!reached_new_depth_ && depth > deepest_) {
    reached_new_depth_ = true;
    ++segment_;
  }
  if (now_ - start_ >= duration_) {
    deepest_ = std::max(deepest_, depth);
    phase_ = Phase::hold;
    start_ = now_;
  }
}

/// Until the contact is gone for long enough; or, where the force ended at once (elastic at nearly no load),
/// after two ramps.
void Press::continue_unloading(double depth)
{
  if (!(now_ - last_touch_ > leaving_time || (depth < -0.5 * deepest_ && last_touch_ < now_))) return;
  if (stop_ + 1 == plan_.stops.size()) finished_ = true;
  phase_ = Phase::stop;
  start_ = now_;
}

void Press::start_next_stop(double now, double depth)
{
  ++stop_;
  ++segment_;
  start_loading(now, depth);
}

void Press::lead(Scene& scene, double time, double dt)
{
  speed_ = target_speed(time + 0.5 * dt);
  drive_->lead(scene, speed_);
}

void Press::apply(Scene& scene, double time, double dt, bool touching)
{
  drive_->set(scene, speed_, dt);
  now_ = time + dt;
  if (drive_->touches(scene, touching)) last_touch_ = now_;
  const double before = work_;
  work_ = drive_->work(scene);
  if (branch() == Branch::load) work_load_ += work_ - before;
  const double depth = overlap(scene);
  switch (phase_) {
    case Phase::load:
      continue_loading(scene, dt, depth);
      break;
    case Phase::hold:
      damp(scene, hold_damping * dt);
      if (now_ - start_ >= hold_time) start_unloading(now_);
      break;
    case Phase::unload:
      continue_unloading(depth);
      break;
    case Phase::stop:
      if (now_ - start_ >= 0.2 * plan_.unload_ramp && !finished_) start_next_stop(now_, depth);
      break;
  }
}

Branch Press::branch() const
{
  if (phase_ == Phase::unload || phase_ == Phase::stop) return Branch::unload;
  return reached_new_depth_ ? Branch::load : Branch::reload;
}

double Press::progress() const
{
  const double before = phase_ == Phase::load ? 0 : phase_ == Phase::hold ? duration_ : duration_ + hold_time;
  const double whole = duration_ + hold_time + plan_.unload_ramp;
  const double done = std::min(1.0, (before + now_ - start_) / whole);
  return std::min(1.0, (static_cast<double>(stop_) + done) / static_cast<double>(plan_.stops.size()));
}

void Press::visit_state(StateArchive& a)
{
  a.expect(plan_.stops.size(), "stops of the press");
  a.value(phase_), a.value(stop_), a.value(segment_);
  for (double* x : {&start_, &from_, &duration_, &unload_speed_, &speed_, &now_, &last_touch_, &force_,
                    &radius_, &deepest_, &work_, &damping_, &work_load_, &work_at_unload_})
    a.value(*x);
  a.value(reached_new_depth_), a.value(finished_);
  drive_->visit_state(a);
}

}  // namespace granulaw
