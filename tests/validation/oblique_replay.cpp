#include "oblique_replay.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// A contact that yields under both forces at (F/F_0)^4 + (T/T_0)^4 = 1.
struct YieldedContact
{
  double tangential, normal;  ///< T/T_0, F/F_0

  explicit YieldedContact(double ratio)  ///< T/T_0 over F/F_0
      : tangential(ratio / std::pow(1 + std::pow(ratio, 4), 0.25)),
        normal(1 / std::pow(1 + std::pow(ratio, 4), 0.25))
  {
  }
};

/// Tangential force on the sphere, along +x, and what the spring remembers.
struct Spring
{
  const TangentialSpring& law;
  double mass;
  double stretch = 0;                // m
  double kept = 1;                   // F over the law's while it deepens
  double work = 0, work_of_law = 0;  // J, of the loading

  /// Changes the normal force where the contact yields under both.
  double force(ContactForce& normal, double hertz_radius, double sliding, double deepening, double dt)
  {
    const double radius = law.computed_radius ? normal.contact_radius : hertz_radius;
    const double k = law.stiffness * radius;
    stretch += sliding * dt;
    double most = std::numeric_limits<double>::infinity();
    if (law.shear_strength > 0 && normal.force > 0) {
      const double strength = law.shear_strength * M_PI * normal.contact_radius * normal.contact_radius;
      most = strength;
      if (deepening > 0) {
        most = flowing(normal, strength, k, sliding / deepening);
        work += deepening * kept * normal.force, work_of_law += deepening * normal.force;
      }
      // an unloading follows the law's from the share of the loading's work that was done
      normal.force *= deepening > 0 || work_of_law == 0 ? kept : work / work_of_law;
    }
    most = std::min(most, law.friction * normal.force);
    if (k * std::abs(stretch) > most) {
      const double force = std::copysign(most, -stretch);
      stretch = k > 0 ? -force / k : 0;
      return force;
    }
    return -k * stretch - 2 * law.damping_ratio * std::sqrt(k * mass) * sliding;
  }

 private:
  /// Tangential force at which it flows in the direction of `slope`, sliding over deepening, along the normal
  /// of the curve: (T/T_0)^3/(F/F_0)^3 = slope T_0/F_0. Friction and the spring may leave less.
  double flowing(const ContactForce& normal, double strength, double k, double slope)
  {
    const double share = strength / normal.force;
    const YieldedContact free(std::cbrt(std::abs(slope) * share));
    const double by_spring = k * std::abs(stretch) / strength;
    const double tangential = std::min(free.tangential, by_spring);
    const double ratio =
        std::min(tangential / std::pow(1 - std::pow(tangential, 4), 0.25), law.friction / share);
    kept = YieldedContact(ratio).normal;
    return free.tangential * strength;
  }
};

}  // namespace

ObliqueAnswer replay_oblique(const BodyLaw& law, const ObliqueThrow& thrown, const TangentialSpring& spring,
                             int steps_per_contact)
{
  const PairLaw pair = wall_pair(law);
  const double r = thrown.radius, m = thrown.mass, inertia = 0.4 * m * r * r;
  const double e_star = pair.mapping.e_star_pair();
  const double hertz_time = 2.87 * std::pow(m * m / (e_star * e_star * r * thrown.velocity), 0.2);
  const double dt = hertz_time / steps_per_contact;
  const double impact_overlap = pair.impact_overlap(r, m, thrown.velocity);
  Spring tangential{spring, m};
  ObliqueAnswer answer;
  ContactForce normal{};
  double delta = 0, deepest = 0, approach = thrown.velocity, along = thrown.tangential_velocity, spin = 0;
  double pull = 0;  // N, tangential force along +x
  const auto kick = [&](double time) {
    const double lever = r - 0.5 * delta;  // LIGGGHTS's
    approach -= time * normal.force / m;
    along += time * pull / m;
    spin -= time * pull * lever / inertia;
  };
  for (long step = 0; step < 100L * steps_per_contact; ++step) {
    kick(0.5 * dt);
    delta += dt * approach;
    if (delta <= 0 || (approach < 0 && normal.force <= 0 && step > 0)) {
      answer.restitution = -approach / thrown.velocity;
      answer.tangential = along, answer.spin = spin;
      answer.impulse_normal = m * (thrown.velocity - approach);
      answer.impulse_tangential = m * (thrown.tangential_velocity - along);
      return answer;
    }
    normal = pair.evaluate(r, delta, deepest, impact_overlap);
    deepest = std::max(deepest, delta);
    const double sliding = along - spin * (r - 0.5 * delta);
    const double deepening = delta >= deepest ? approach : 0;
    pull = tangential.force(normal, std::sqrt(r * delta), sliding, deepening, dt);
    answer.force_max = std::max(answer.force_max, normal.force);
    answer.tangential_force_max = std::max(answer.tangential_force_max, std::abs(pull));
    kick(0.5 * dt);
  }
  fail("replay of an oblique impact", "the collision did not end");
}

}  // namespace granulaw
