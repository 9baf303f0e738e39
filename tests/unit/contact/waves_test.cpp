// Waves of Tabulated: C K^2 v in the caller's units, stretched.
#include <gtest/gtest.h>

#include <vector>

#include "contact/tabulated.hpp"
#include "law/radiation.hpp"
#include "synthetic_law.hpp"

namespace granulaw::waves_test {

class Waves : public ::testing::Test
{
 protected:
  const Law law = granulaw::tests::SyntheticLaw{}.law_with_axis();
  const BodyLaw& powder = law.bodies.at("powder");
  const PairLaw pair{{&powder.curve, PairMapping::deformable_partner(powder.material.e_star(), 2e10),
                      radiation(powder.material, 1.0, powder.material, 8.0)},
                     &powder};
  static constexpr double r_eff = 1.5e-3, speed = 3.0;

  Tabulated contact(Scale scale) const { return {pair, pair.measure(), scale}; }

  struct State
  {
    double delta, delta_max, impact_overlap;
  };
  // elastic, loading, its reversal, far back; without and with the axis's part
  const std::vector<State> states{{1e-7, 0, 0},        {2e-5, 1.9e-5, 0}, {1.9e-5, 2e-5, 0},
                                  {1.7e-5, 2e-5, 0},   {1e-6, 2e-5, 0},   {2e-5, 1.9e-5, 0.01},
                                  {1.8e-5, 2e-5, 0.01}};

  /// N, force of waves, of the deck's contact at S times the overlap.
  double force(const State& s, const Scale& scale) const
  {
    const Tabulated c = contact(scale);
    double history[values_of(Tabulated::history_values)] = {};
    const double r = r_eff / scale.length, delta = scale.stretch * s.delta / scale.length,
                 delta_max = scale.stretch * s.delta_max / scale.length;
    const double k = c.response(r, delta, delta_max, s.impact_overlap, history).stiffness;
    return c.radiation * k * k * (speed / scale.length) * scale.mass * scale.length;
  }
};

TEST_F(Waves, ForceAndStiffnessAreThoseOfTheBranch)
{
  const Tabulated c = contact({});
  for (const State& s : states) {
    double history[values_of(Tabulated::history_values)] = {};
    const Response found = c.response(r_eff, s.delta, s.delta_max, s.impact_overlap, history);
    const double expected =
        answer(powder.curve, pair.mapping, r_eff, s.delta, s.delta_max, s.impact_overlap).stiffness;
    EXPECT_NEAR(found.stiffness, expected, 1e-12 * expected);
    EXPECT_EQ(found.force, c.force(r_eff, s.delta, s.delta_max, s.impact_overlap, history));
  }
}

TEST_F(Waves, TakeTheSameShareOfAStretchedContact)
{
  for (const State& s : states) {
    const double real = force(s, {}), stretch = 20;
    EXPECT_NEAR(force(s, {.stretch = stretch}), real / stretch, 1e-12 * real);  // as the law's own force
  }
}

TEST_F(Waves, AreTheSameInCgs)
{
  const Scale cgs{.length = 0.01, .mass = 0.001};
  EXPECT_NEAR(contact(cgs).radiation, pair.radiation * 1e-3, 1e-15 * pair.radiation);  // s^3/g
  for (const State& s : states) {
    const double expected = force(s, {.stretch = 5});
    EXPECT_NEAR(force(s, {cgs.length, cgs.mass, 5}), expected, 1e-12 * expected);
  }
}

}  // namespace granulaw::waves_test
