// A contact that keeps its reversal: the force with it and without it, and the shorter way of a contact that
// loads.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "contact/tabulated.hpp"
#include "contact/thornton.hpp"
#include "synthetic_law.hpp"

namespace granulaw::kept_reversal_test {

struct Step
{
  double r_eff, delta;
};

/// A contact that goes in and out at random, deeper now and then, between spheres whose radii grow.
std::vector<Step> path(unsigned seed, double deepest)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Step> steps;
  double r_eff = 1e-3, reached = 1e-8;
  for (int k = 0; k < 20000; ++k) {
    if (k % 7 == 0) r_eff *= 1.0 + 1e-4 * part(random);
    if (k % 3 == 0) reached = std::min(reached * (1.0 + 0.05 * part(random)), deepest * r_eff);
    steps.push_back({r_eff, k % 3 == 0 ? reached : reached * part(random)});
  }
  return steps;
}

template <class Contact>
void expect_the_same_force_with_what_is_kept(const Contact& contact, double deepest, double impact_overlap)
{
  double delta_max = 0.0, history[values_of(Contact::history_values)] = {};
  for (const auto& [r_eff, delta] : path(11, deepest)) {
    double fresh[values_of(Contact::history_values)] = {};
    const double force = contact.force(r_eff, delta, delta_max, impact_overlap, history);
    ASSERT_EQ(force, contact.force(r_eff, delta, delta_max, impact_overlap, fresh));
    if (delta <= delta_max) continue;
    ASSERT_EQ(contact.loading(r_eff, delta, impact_overlap), force);
    const double expected = contact.dissipated(r_eff, delta_max, delta, impact_overlap);
    // the difference of two works: rounding counts against these
    const double work = contact.loading(r_eff, delta, impact_overlap) * delta;
    ASSERT_NEAR(contact.grow(r_eff, delta_max, delta, impact_overlap, history), expected, 1e-14 * work);
    // the reversal that the loss was worked out from is there for the next step
    contact.force(r_eff, 0.9 * delta, delta, impact_overlap, fresh);
    for (std::size_t k = 0; k < std::size(fresh); ++k) ASSERT_EQ(history[k], fresh[k]);
    delta_max = delta;
  }
  EXPECT_GT(delta_max, 0.5 * deepest * 1e-3);
}

TEST(KeptReversal, LeavesTheForceOfTheTableAsItIs)
{
  const Law law = granulaw::tests::SyntheticLaw{}.law_with_axis();
  const BodyLaw& powder = law.bodies.at("powder");
  const PairLaw pair{{&powder.curve, PairMapping::deformable_partner(powder.material.e_star(), 2e10)},
                     &powder};
  for (const double stretch : {1.0, 3.0})
    for (const double impact_overlap : {0.0, 0.01})
      expect_the_same_force_with_what_is_kept(Tabulated(pair, pair.measure(), {.stretch = stretch}), 0.05,
                                              impact_overlap);
}

TEST(KeptReversal, LeavesTheForceOfThorntonAsItIs)
{
  for (const double yield_pressure : {1.6e6, 1.6e7, 1.6e30})  // deep, in mid-path, never
    for (const double stretch : {1.0, 3.0})
      expect_the_same_force_with_what_is_kept(Thornton(1e8, yield_pressure, stretch), 0.05, 0.0);
}

/// A contact that is booked when it turns loses what one loses that is booked in each step that takes it deeper.
template <class Contact>
void expect_the_same_books_at_turns(const Contact& contact, double deepest, double impact_overlap)
{
  constexpr double r_eff = 1e-3;
  double delta_max = 0.0, each = 0.0, later = 0.0, history[values_of(Contact::history_values)] = {}, other[std::size(history)] = {};
  for (const Step& step : path(7, deepest)) {
    if (const double delta = step.delta; delta > delta_max) {
      each += contact.grow(r_eff, delta_max, delta, impact_overlap, history);
      if (delta_max > 0.0)
        contact.postpone(other);
      else
        later += contact.settle(r_eff, delta, impact_overlap, other);
      delta_max = delta;
    } else if (contact.owes(r_eff, delta_max, other)) {
      later += contact.settle(r_eff, delta_max, impact_overlap, other);
      ASSERT_FALSE(contact.owes(r_eff, delta_max, other));
      ASSERT_NEAR(contact.booked(r_eff, other), delta_max, 1e-15 * delta_max);
      ASSERT_EQ(contact.force(r_eff, delta, delta_max, impact_overlap, other),
                contact.force(r_eff, delta, delta_max, impact_overlap, history));
    }
  }
  EXPECT_NEAR(later, each, 1e-12 * each);  // rounding of some thousand differences of works
}

TEST(KeptReversal, IsBookedInEachStepOrAtTurns)
{
  const Law law = granulaw::tests::SyntheticLaw{}.law_with_axis();
  const BodyLaw& powder = law.bodies.at("powder");
  const PairLaw pair{{&powder.curve, PairMapping::deformable_partner(powder.material.e_star(), 2e10)}, &powder};
  for (const double impact_overlap : {0.0, 0.01})
    expect_the_same_books_at_turns(Tabulated(pair, pair.measure(), {.stretch = 3.0}), 0.05, impact_overlap);
  for (const double yield_pressure : {1.6e6, 1.6e7, 1.6e30})
    expect_the_same_books_at_turns(Thornton(1e8, yield_pressure, 3.0), 0.05, 0.0);
}

}  // namespace granulaw::kept_reversal_test
