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

template <class Element>
ObliqueAnswer collide(const Element& element, const ObliqueThrow& thrown, TangentialKind kind, double dt,
                      long most_steps)
{
  const double r = thrown.radius, m = thrown.mass, inertia = 0.4 * m * r * r;
  double delta = 0, approach = thrown.velocity, along = thrown.tangential_velocity, spin = 0, deepest = 0;
  std::array<double, Element::values> kept{};
  Ledger books;
  ContactForce now;
  // x along the wall, z from the wall to the sphere: a sphere that rolls along x spins about y
  const auto kick = [&](double time) {
    approach -= time * now.normal / m;
    along += time * now.shear[0] / m;
    spin += time * (-now.shear[0] * lever_of(kind, r, delta) + now.couple[1]) / inertia;
  };
  for (long step = 0; step < most_steps; ++step) {
    kick(0.5 * dt);
    delta += dt * approach;
    if (delta <= 0 || (approach < 0 && now.normal <= 0 && step > 0)) {
      double taken = 0;
      for (const double one : books.taken) taken += one;
      return {-approach / thrown.velocity, along, spin, m * (thrown.velocity - approach),
              m * (thrown.tangential_velocity - along), deepest, taken};
    }
    deepest = std::max(deepest, delta);
    now = element.advance({{r, delta, approach, true},
                           m,
                           dt,
                           {0, 0, 1},
                           {along - spin * lever_of(kind, r, delta), 0, 0},
                           {spin, 0, 0}},
                          kept.data(), books);
    kick(0.5 * dt);
  }
  fail("replay of an oblique impact", "the collision did not end");
}

}  // namespace

ObliqueAnswer replay_oblique(const PairLaw& pair, const ObliqueThrow& thrown, TangentialKind kind, double friction,
                             double damping_ratio, int steps)
{
  const double e_star = pair.mapping.e_star_pair(), m = thrown.mass, r = thrown.radius;
  if (const double fastest = pair.max_speed(r, m); thrown.velocity > fastest)
    fail("replay of an oblique impact", "is faster than the law holds for", fmt::format("{:.4g} m/s", thrown.velocity),
         fmt::format("up to {:.4g} m/s", fastest));
  const double dt = customary_contact_time(e_star, r, m, thrown.velocity) / steps;
  const Tabulated normal(pair, pair.measure(), Scale{});
  const LawMaterial& material = pair.yielding->material;
  const ElasticBody body{material.youngs_modulus, material.poisson_ratio};
  const BodiesInShear bodies = BodiesInShear::of(body, ElasticBody{}, damping_ratio);
  const ShearPair spring = ShearPair::of(bodies.stiffness, friction, damping_ratio);
  const PlasticShear plastic(normal, spring, bodies);
  const long most = 100L * steps;
  const ObliqueAnswer answer =
      kind == TangentialKind::plastic && plastic.turns()
          ? collide(ContactElement<Tabulated, PlasticShear>{normal, plastic}, thrown, kind, dt, most)
          : collide(ContactElement<Tabulated, Spring>{normal, Spring(spring)}, thrown, TangentialKind::history, dt, most);
  if (answer.overlap_max > pair.max_overlap(r))
    fail("replay of an oblique impact", "goes deeper than the law holds for",
         fmt::format("{:.4g} R", answer.overlap_max / r), fmt::format("up to {:.4g} R", pair.max_overlap(r) / r));
  return answer;
}

}  // namespace granulaw
