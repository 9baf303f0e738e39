#include "law/replay.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "contact/adhesion.hpp"
#include "contact/body_behind.hpp"
#include "law/contact_time.hpp"

namespace granulaw {

namespace {

/// C K^2 v of the dashpot that stands for waves; a contact never pulls.
double with_waves(const Answer& now, double radiation, double speed)
{
  return std::max(now.force + radiation * now.stiffness * now.stiffness * speed, 0.0);
}

Replay replay(const NormalForce& law, double radiation, double effective_mass, double velocity,
              double duration_guess, int steps_per_contact)
{
  if (!(velocity > 0 && effective_mass > 0 && duration_guess > 0 && steps_per_contact > 0))
    fail("replay", "velocity, mass, duration and steps must be positive");
  Replay result;
  const double dt = duration_guess / steps_per_contact;
  double time = 0, delta = 0, delta_max = 0, v = velocity;
  double total = 0;
  Answer now{};
  const auto longest = static_cast<long>(steps_per_contact) * 100;
  for (long step = 0; step < longest; ++step) {
    result.samples.push_back({time, delta, total, now.contact_radius, v < 0});
    v -= 0.5 * dt * total / effective_mass;
    const double before = delta, force_before = total, law_before = now.force;
    delta += dt * v;
    if (delta <= 0)
      now = {};
    else
      now = law(delta, delta_max);
    delta_max = std::max(delta, delta_max);
    total = with_waves(now, radiation, v);
    v -= 0.5 * dt * total / effective_mass;
    time += dt;
    const double work = 0.5 * (force_before + total) * (delta - before);
    (work > 0 ? result.work_load : result.work_unload) += std::abs(work);
    result.work_waves += work - 0.5 * (law_before + now.force) * (delta - before);
    result.force_max = larger(result.force_max, total);
    if (v < 0 && total <= 0) {
      result.restitution = -v / velocity;
      result.delta_max = delta_max;
      result.delta_residual = std::max(0.0, delta);
      result.contact_time = time;
      result.samples.push_back({time, delta, 0.0, 0.0, true});
      return result;
    }
  }
  fail("replay", "the collision did not end within a hundred times the expected contact time");
}

/// With attraction between the surfaces. Work that the contact gives back while it approaches counts against the work put in.
Replay replay_adhesive(const PairLaw& pair, double r_eff, double effective_mass, double mass, double velocity, double duration, int steps_per_contact, const Attraction& attraction)
{
  using Element = ContactElement<Tabulated, Frictionless, DentAdhesion>;
  const Tabulated law(pair, pair.measure(), {});
  const Element element{law, {}, 0, 0, DentAdhesion(law, attraction.work, attraction.range)};
  std::array<double, Element::values> history{};
  Ledger ledger;
  Replay result;
  const double dt = duration / steps_per_contact;
  double time = 0, delta = 0, v = velocity;
  ContactForce now;
  const auto longest = static_cast<long>(steps_per_contact) * 100;
  for (long step = 0; step < longest; ++step) {
    // X is that of the effective mass: the body that moves may be another
    ContactMotion m{{r_eff, delta, v, true}, effective_mass, dt, {0, 0, 1}};
    result.samples.push_back({time, delta, now.normal, delta > 0 ? element.contact_radius(m, history.data()) : 0.0, v < 0});
    const bool parted = v < 0;
    const double force_before = now.normal, before = delta;
    v -= 0.5 * dt * now.normal / mass;
    delta += dt * v;
    m.overlap = delta, m.approach = v;
    now = element.advance(m, history.data(), ledger);
    v -= 0.5 * dt * now.normal / mass;
    time += dt;
    const double done = 0.5 * (force_before + now.normal) * (delta - before);
    v > 0 ? result.work_load += done : result.work_unload -= done;
    result.force_max = larger(result.force_max, now.normal), result.delta_max = larger(result.delta_max, delta);
    result.sticks = parted && v > 0;
    if (result.sticks || (v < 0 && now.normal == 0 && !DentAdhesion::holds(history.data() + Element::beside_at))) {
      result.restitution = result.sticks ? 0 : -v / velocity;
      result.delta_residual = std::max(0.0, delta);
      result.contact_time = time;
      result.work_waves = ledger[Mechanism::waves];
      result.pull_off = element.beside.pull_off(law, r_eff, result.delta_max);
      result.samples.push_back({time, delta, 0.0, 0.0, true});
      return result;
    }
  }
  fail("replay", "the collision did not end within a hundred times the expected contact time");
}

}  // namespace

Replay replay_collision(const NormalForce& law, double effective_mass, double velocity, double duration_guess,
                        int steps_per_contact)
{
  return replay(law, 0.0, effective_mass, velocity, duration_guess, steps_per_contact);
}

Replay replay_collision(const PairLaw& pair, double r_eff, double effective_mass, double velocity,
                        int steps_per_contact, const ImpactBody& body, const Attraction& attraction)
{
  const double moved = body.mass > 0 ? body.mass : effective_mass;
  const double duration = customary_contact_time(pair.mapping.e_star_pair(), r_eff, moved, velocity);
  const double impact_overlap = pair.impact_overlap(r_eff, effective_mass, velocity);
  double deepest = 0;  // of the law
  const auto respond = [&](double x) { return pair.evaluate(r_eff, x, deepest, impact_overlap); };
  Replay result = attraction.work > 0 ? replay_adhesive(pair, r_eff, effective_mass, moved, velocity, duration, steps_per_contact, attraction) : replay(
      [&](double delta, double) {
        const Answer now = respond(overlap_of_law(delta, body.compliance, deepest, respond));
        deepest = now.delta_max;
        return now;
      },
      pair.radiation, moved, velocity, duration, steps_per_contact);
  result.left_speeds = velocity > pair.max_speed(r_eff, effective_mass);
  result.held_speed = velocity < pair.min_speed(r_eff, effective_mass);
  if (attraction.work > 0) deepest = result.delta_max;
  result.left_range = deepest > pair.max_overlap(r_eff);
  return result;
}

Replay replay_on_wall(const BodyLaw& body, double radius, double mass, double velocity, double compliance)
{
  return replay_collision(wall_pair(body), radius, mass, velocity, 20000, {.compliance = compliance});
}

}  // namespace granulaw
