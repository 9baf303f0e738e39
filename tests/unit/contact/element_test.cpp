// A contact of two bodies as one element: its work is in the ledger, its state ends with it.
#include "contact/element.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "contact/tabulated.hpp"
#include "contact/thornton.hpp"
#include "law/radiation.hpp"
#include "synthetic_law.hpp"

namespace granulaw::element_test {

const Law law = tests::SyntheticLaw{}.law_with_axis();

Tabulated tabulated(double waves)
{
  const BodyLaw& powder = law.bodies.at("powder");
  const PairLaw pair{{&powder.curve, PairMapping::deformable_partner(powder.material.e_star(), 2e10),
                      waves * radiation(powder.material, 1.0, powder.material, 8.0)},
                     &powder};
  return {pair, pair.measure(), {}};
}

struct Collision
{
  double speed = 0, slide = 0;  ///< m/s, after it
  double slid_work = 0;         ///< J, that the tangential force took
  Ledger ledger;
  std::vector<double> history;
};

/// Two bodies thrown at each other, by velocity Verlet; the shear force slows a slide that turns no body.
template <class Element>
Collision collide(const Element& element, double speed, double slide, double dt)
{
  constexpr double r_eff = 1e-3, mass = 6e-6;
  Collision now;
  now.history.assign(Element::values, 0.0);
  double overlap = 0, v = speed, u = slide;
  ContactForce force;
  do {
    v -= 0.5 * dt * force.normal / mass, u += 0.5 * dt * force.shear[0] / mass;
    overlap += dt * v;
    ContactMotion m{{r_eff, overlap, v, true}, mass, dt, {0, 0, 1}, {u, 0, 0}};
    force = element.advance(m, now.history.data(), now.ledger);
    v -= 0.5 * dt * force.normal / mass, u += 0.5 * dt * force.shear[0] / mass;
  } while (v > 0 || force.normal > 0);
  now.speed = -v, now.slide = u;
  return now;
}

constexpr double mass = 6e-6, speed = 2.0;

TEST(ContactElement, BooksWhatACollisionLoses)
{
  for (const double waves : {0.0, 1.0}) {
    const ContactElement<Tabulated> element{tabulated(waves)};
    const Collision end = collide(element, speed, 0.0, 2e-9);
    const double lost = 0.5 * mass * (speed * speed - end.speed * end.speed);
    EXPECT_EQ(end.ledger[Mechanism::waves] > 0, waves > 0);
    EXPECT_EQ(end.ledger[Mechanism::friction], 0);
    // the work of loading with a velocity axis is a table, between its levels as good as least_loss
    EXPECT_NEAR(end.ledger[Mechanism::plastic] + end.ledger[Mechanism::waves], lost,
                Curve::least_loss * 0.5 * mass * speed * speed);
  }
  const ContactElement<Thornton> thornton{Thornton(1e9, 1.6e7)};
  const Collision end = collide(thornton, speed, 0.0, 2e-9);
  const double lost = 0.5 * mass * (speed * speed - end.speed * end.speed);
  EXPECT_NEAR(end.ledger[Mechanism::plastic], lost, 1e-4 * lost);  // velocity Verlet, some thousand steps
}

TEST(ContactElement, BooksWhatFrictionTakes)
{
  const Spring spring(ShearPair::of(8e9, 0.3, 0.0));
  const ContactElement<Tabulated, Spring> element{tabulated(0.0), spring};
  const Collision end =
      collide(element, speed, 5.0, 2e-9);  // slides all along: mu (1 + e) V is less than 5 m/s
  const double lost = 0.5 * mass * (5.0 * 5.0 - end.slide * end.slide);
  EXPECT_NEAR(5.0 - end.slide, 0.3 * (speed + end.speed), 1e-3);
  // the spring keeps what it held when the normal force began to fall: mu F/k of F dt's work
  EXPECT_NEAR(end.ledger[Mechanism::friction], lost, 0.02 * lost);
}

TEST(ContactElement, KeepsNothingOfAContactThatEnded)
{
  const ContactElement<Tabulated, Spring> element{tabulated(1.0), Spring(ShearPair::of(8e9, 0.3, 0.0))};
  Collision end = collide(element, speed, 5.0, 2e-8);
  EXPECT_GT(NormalState<Tabulated>::largest(end.history.data()), 0);
  ContactMotion apart{{1e-3, -1e-9, -1.0, true}, mass, 1e-9, {0, 0, 1}, {}};
  const ContactForce force = element.advance(apart, end.history.data(), end.ledger);
  EXPECT_EQ(force.normal, 0);
  EXPECT_EQ(end.history, std::vector<double>(element.values, 0.0));
}

TEST(ContactElement, AStepThatDoesNotAdvanceKeepsAndBooksNothing)
{
  const ContactElement<Tabulated, Spring> element{tabulated(1.0), Spring(ShearPair::of(8e9, 0.3, 0.0))};
  std::vector<double> history(element.values, 0.0);
  Ledger ledger;
  ContactMotion m{{1e-3, 1e-6, 1.0, true}, mass, 1e-8, {0, 0, 1}, {1, 0, 0}};
  element.advance(m, history.data(), ledger);
  const std::vector<double> before = history;
  const Ledger booked = ledger;
  m.overlap = 2e-6, m.advances = false;
  const ContactForce asked = element.advance(m, history.data(), ledger);
  EXPECT_EQ(history, before);
  EXPECT_EQ(ledger.taken, booked.taken);
  m.advances = true;
  EXPECT_EQ(element.advance(m, history.data(), ledger).normal, asked.normal);
}

/// Parts of the state that follow from the rest may be dropped at any step, as at a restart.
TEST(ContactElement, WorksOutAnewWhatFollowsFromTheRest)
{
  const auto element = ContactElement<Tabulated>{tabulated(1.0)};
  std::vector<double> history(element.values, 0.0), other = history;
  Ledger ledger, other_books;
  for (const double overlap : {1e-6, 5e-6, 2e-5, 1.95e-5, 1.8e-5, 1.9e-5, 2.1e-5, 2.0e-5}) {
    const ContactMotion m{{1e-3, overlap, 1.0, true}, mass, 1e-8, {0, 0, 1}, {}};
    NormalState<Tabulated>::forget_derived(other.data());
    EXPECT_EQ(element.advance(m, history.data(), ledger).normal,
              element.advance(m, other.data(), other_books).normal);
  }
}

}  // namespace granulaw::element_test
