#include "solver/loading/compaction.hpp"

#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace granulaw {

namespace {

/// Strain over which the speed rises at the start, and time over which it turns, both times the rate.
constexpr double start_strain = 0.02, turn_strain = 0.01;
/// Speed of the unloading over that of the loading.
constexpr double back_speed = 0.2;
/// Way that is left when the turn begins, over turn_strain: integral of the speed up to its zero.
const double turn_way = [] {
  const double zero = std::acos(1 - 2 / (1 + back_speed)) / M_PI;
  return zero - 0.5 * (1 + back_speed) * (zero - std::sin(M_PI * zero) / M_PI);
}();

}  // namespace

Compaction::Compaction(PackingContact& contact, const Plan& plan)
    : contact_(contact), plan_(plan), moves_(contact.box.periodic ? Vector3(1, 1, 1) : Vector3(0, 0, 1))
{
  start_density_ = density();
  turn_density_ = plan.density;
  if (plan.unloads) turn_density_ *= std::exp(-moves_.sum() * turn_strain * turn_way);
}

double Compaction::turn_time() const
{
  return turn_strain / plan_.rate;
}

double Compaction::speed(double time) const
{
  const double start = std::min(1.0, time * plan_.rate / start_strain);
  const double speed = 0.5 * (1 - std::cos(M_PI * start));
  if (phase_ == Phase::load) return speed;
  const double turn = std::min(1.0, (time - turned_) / turn_time());
  return speed - (speed + back_speed) * 0.5 * (1 - std::cos(M_PI * turn));
}

void Compaction::lead(Scene& scene, double time, double dt)
{
  const Vector3 before = strain_rate_;
  strain_rate_ = -plan_.rate * speed(time) * moves_;
  contact_.box.rate = strain_rate_.cwiseProduct(contact_.box.length);
  // x'' = (e' + e^2) x of an affine motion x' = e x
  const Vector3 gain = strain_rate_ - before + dt * strain_rate_.cwiseAbs2();
  std::vector<double> works(scene.bodies.size());
  scene.threads->each(static_cast<int>(works.size()), [&](int b, int) {
    Body& body = scene.bodies[b];
    const Vector3 more = gain.cwiseProduct(contact_.balls()[b].centre(body));
    works[b] = body.mass() * more.dot(mean_velocity(body) + 0.5 * more);
    add_velocity(body, more);
  });
  for (std::size_t b = 0; b < works.size(); ++b) {
    work_ += works[b];
    given_ += scene.bodies[b].mass() * gain.cwiseProduct(contact_.balls()[b].centre(scene.bodies[b]));
  }
}

void Compaction::apply(Scene&, double time, double dt, bool)
{
  contact_.box.length += dt * contact_.box.rate;
  if (phase_ != Phase::load || density() < turn_density_) return;
  if (plan_.unloads)
    phase_ = Phase::back, turned_ = time + dt;
  else
    phase_ = Phase::ended;
}

double Compaction::progress() const
{
  const double way = std::log(density() / start_density_) / std::log(plan_.density / start_density_);
  if (!plan_.unloads) return std::clamp(way, 0.0, 1.0);
  return phase_ == Phase::load ? 0.8 * std::clamp(way, 0.0, 1.0) : 0.9;
}

void Compaction::visit_state(StateArchive& a)
{
  a.value(phase_), a.value(turned_), a.value(work_);
  for (int d = 0; d < 3; ++d) a.value(strain_rate_[d]), a.value(given_[d]);
}

}  // namespace granulaw
