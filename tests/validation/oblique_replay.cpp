#include "oblique_replay.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "yielding_contact.hpp"

namespace granulaw {

namespace {

/// The law's normal force and LIGGGHTS's `tangential history`.
class SpringContact
{
 public:
  SpringContact(const PairLaw& pair, const ObliqueThrow& thrown, double impact_overlap,
                const TangentialSpring& spring)
      : pair_(pair), thrown_(thrown), impact_overlap_(impact_overlap), spring_(spring)
  {
  }

  ContactForces move(double delta, double slide, double dt)
  {
    const Answer normal = pair_.evaluate(thrown_.radius, delta, deepest_, impact_overlap_);
    deepest_ = std::max(deepest_, delta);
    const double radius = spring_.computed_radius ? normal.contact_radius : std::sqrt(thrown_.radius * delta);
    const double k = spring_.stiffness * radius, most = spring_.friction * normal.force;
    stretch_ += slide;
    if (k * std::abs(stretch_) > most) {
      const double force = std::copysign(most, stretch_);
      stretch_ = force / k;
      return {normal.force, force};
    }
    const double damping = 2 * spring_.damping_ratio * std::sqrt(k * thrown_.mass);
    return {normal.force, k * stretch_ + damping * slide / dt};
  }

 private:
  const PairLaw& pair_;
  const ObliqueThrow& thrown_;
  double impact_overlap_;
  const TangentialSpring& spring_;
  double stretch_ = 0, deepest_ = 0;  // m
};

/// Velocity Verlet, as LIGGGHTS integrates one contact.
template <class Contact>
ObliqueAnswer collide(Contact& contact, const ObliqueThrow& thrown, double dt, long most_steps)
{
  const double r = thrown.radius, m = thrown.mass, inertia = 0.4 * m * r * r;
  double delta = 0, approach = thrown.velocity, along = thrown.tangential_velocity, spin = 0;
  ContactForces forces{};
  const auto lever = [&] { return r - 0.5 * delta; };  // LIGGGHTS's
  const auto kick = [&](double time) {
    approach -= time * forces.normal / m;
    along -= time * forces.tangential / m;
    spin += time * forces.tangential * lever() / inertia;
  };
  for (long step = 0; step < most_steps; ++step) {
    kick(0.5 * dt);
    delta += dt * approach;
    if (delta <= 0 || (approach < 0 && forces.normal <= 0 && step > 0))
      return {-approach / thrown.velocity, along, spin, m * (thrown.velocity - approach),
              m * (thrown.tangential_velocity - along)};
    forces = contact.move(delta, dt * (along - spin * lever()), dt);
    kick(0.5 * dt);
  }
  fail("replay of an oblique impact", "the collision did not end");
}

/// Data common to the replays of one impact.
struct Replay
{
  PairLaw pair;
  double dt, impact_overlap;
  long most_steps;

  Replay(const BodyLaw& law, const ObliqueThrow& thrown, int steps_per_contact)
      : pair(wall_pair(law)), most_steps(100L * steps_per_contact)
  {
    const double e_star = pair.mapping.e_star_pair(), m = thrown.mass;
    const double hertz_time =
        2.87 * std::pow(m * m / (e_star * e_star * thrown.radius * thrown.velocity), 0.2);
    dt = hertz_time / steps_per_contact;
    impact_overlap = pair.impact_overlap(thrown.radius, m, thrown.velocity);
  }
};

}  // namespace

ObliqueAnswer replay_spring(const BodyLaw& law, const ObliqueThrow& thrown, const TangentialSpring& spring,
                            int steps_per_contact)
{
  const Replay replay(law, thrown, steps_per_contact);
  SpringContact contact(replay.pair, thrown, replay.impact_overlap, spring);
  return collide(contact, thrown, replay.dt, replay.most_steps);
}

ObliqueAnswer replay_yielding(const BodyLaw& law, const ObliqueThrow& thrown, const TangentialSpring& spring,
                              const FlowStress& material, int steps_per_contact)
{
  const Replay replay(law, thrown, steps_per_contact);
  YieldingContact contact(replay.pair, thrown.radius, replay.impact_overlap, spring.stiffness,
                          spring.friction, material);
  return collide(contact, thrown, replay.dt, replay.most_steps);
}

}  // namespace granulaw
