#include "law/oblique.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "contact/element.hpp"
#include "contact/tabulated.hpp"
#include "law/contact_time.hpp"

namespace granulaw {

namespace {

/// Distance from the centre to where the tangential force acts.
double lever_of(TangentialKind kind, double radius, double overlap)
{
  return kind == TangentialKind::plastic ? radius - overlap : radius - 0.5 * overlap;
}

/// One of the two spheres as it turns.
struct Turning
{
  double radius, inertia, spin = 0;

  static Turning sphere(double radius, double mass) { return {radius, 0.4 * mass * radius * radius}; }
};

/// In the plane of the velocities: x along the wall, z from the partner to the sphere. A sphere that rolls along x
/// spins about y. The line of two centres turns as they pass each other.
template <class Element>
ObliqueAnswer collide(const Element& element, const ObliqueThrow& thrown, TangentialKind kind, double dt,
                      long most_steps)
{
  const ObliquePartner& other = thrown.partner;
  const bool wall = thrown.at_wall();
  const double m = thrown.m_eff(), r = thrown.r_eff();
  Turning sphere = Turning::sphere(thrown.radius, thrown.mass), partner = Turning::sphere(other.radius, other.mass);
  double delta = 0, deepest = 0, along = thrown.tangential_velocity, away = -thrown.velocity;
  double x = 0, z = thrown.radius + other.radius;  // of the sphere's centre from the partner's
  Vector normal{0, 0, 1}, along_it{1, 0, 0};
  std::array<double, Element::values> history{};
  Ledger ledger;
  ContactForce now;
  const auto lever = [&](const Turning& of) {
    return lever_of(wall ? kind : TangentialKind::history, of.radius, delta);
  };
  const auto kick = [&](double time) {
    const double push = dot(now.shear, along_it), couple = now.couple[1];
    along += time * (now.normal * normal[0] + now.shear[0]) / m;
    away += time * (now.normal * normal[2] + now.shear[2]) / m;
    sphere.spin += time * (-push * lever(sphere) + couple) / sphere.inertia;
    if (!wall) partner.spin += time * (-push * lever(partner) - couple) / partner.inertia;
  };
  for (long step = 0; step < most_steps; ++step) {
    kick(0.5 * dt);
    if (wall) {
      delta -= dt * away;
    } else {
      x += dt * along, z += dt * away;
      const double apart = std::hypot(x, z);
      delta = thrown.radius + other.radius - apart;
      normal = {x / apart, 0, z / apart}, along_it = {normal[2], 0, -normal[0]};
    }
    const double approach = -(along * normal[0] + away * normal[2]);
    if (delta <= 0 || (approach < 0 && now.normal <= 0 && step > 0)) {
      double taken = 0;
      for (const double one : ledger.taken) taken += one;
      return {away / thrown.velocity, along, sphere.spin, partner.spin, m * (thrown.velocity + away),
              m * (thrown.tangential_velocity - along), deepest, taken};
    }
    deepest = std::max(deepest, delta);
    double slide = along * along_it[0] + away * along_it[2] - sphere.spin * lever(sphere);
    if (!wall) slide -= partner.spin * lever(partner);
    now = element.advance({{r, delta, approach, true},
                           m,
                           dt,
                           normal,
                           times(along_it, slide),
                           times(along_it, sphere.spin - partner.spin)},
                          history.data(), ledger);
    kick(0.5 * dt);
  }
  fail("replay of an oblique impact", "the collision did not end");
}

}  // namespace

ObliqueAnswer replay_oblique(const PairLaw& pair, const ObliqueThrow& thrown, TangentialKind kind, double friction,
                             double damping_ratio, int steps)
{
  const double e_star = pair.mapping.e_star_pair(), m = thrown.m_eff(), r = thrown.r_eff();
  if (!(thrown.velocity > 0 && std::isfinite(thrown.velocity) && std::isfinite(thrown.tangential_velocity) && m > 0 && r > 0 && steps > 0))
    fail("replay of an oblique impact", "velocity, mass, radius and steps must be positive");
  if (const double fastest = pair.max_speed(r, m); thrown.velocity > fastest)
    fail("replay of an oblique impact", "is faster than the law holds for", fmt::format("{:.4g} m/s", thrown.velocity),
         fmt::format("up to {:.4g} m/s", fastest));
  const double dt = customary_contact_time(e_star, r, m, thrown.velocity) / steps;
  const Tabulated normal(pair, pair.measure(), Scale{});
  const LawMaterial& material = pair.yielding->material;
  const ElasticBody body{material.youngs_modulus, material.poisson_ratio};
  const BodiesInShear bodies = BodiesInShear::of(body, thrown.partner.body, damping_ratio);
  const ShearPair spring = ShearPair::of(bodies.stiffness, friction, damping_ratio);
  const PlasticShear plastic(normal, spring, bodies);
  const long most = 100L * steps;
  const ObliqueAnswer answer =
      kind == TangentialKind::plastic && plastic.yields()
          ? collide(ContactElement<Tabulated, PlasticShear>{normal, plastic}, thrown, kind, dt, most)
          : collide(ContactElement<Tabulated, Spring>{normal, Spring(spring)}, thrown, TangentialKind::history, dt, most);
  if (answer.overlap_max > pair.max_overlap(r))
    fail("replay of an oblique impact", "goes deeper than the law holds for",
         fmt::format("{:.4g} R", answer.overlap_max / r), fmt::format("up to {:.4g} R", pair.max_overlap(r) / r));
  return answer;
}

}  // namespace granulaw
