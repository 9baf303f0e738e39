// Waves of MpmContact: C K^2 v in the deck's units, stretched.
#include <gtest/gtest.h>

#include <vector>

#include "law/radiation.hpp"
#include "liggghts_plugin/mpm_physics.hpp"
#include "synthetic_law.hpp"

namespace granulaw::plugin {
namespace {

class Waves : public ::testing::Test
{
 protected:
  const Law law = granulaw::testing::SyntheticLaw{}.law_with_axis();
  const BodyLaw& powder = law.bodies.at("powder");
  const PairLaw pair{{&powder.curve, PairMapping::deformable_partner(powder.material.e_star(), 2e10),
                      radiation(powder.material, 1.0, powder.material, 8.0)},
                     &powder};
  static constexpr double r_eff = 1.5e-3, speed = 3.0;

  MpmContact contact(double stretch, const DeckUnits& units) const { return {pair, stretch, units}; }

  struct State
  {
    double delta, delta_max, impact_overlap;
  };
  // elastic, loading, its reversal, far back; without and with the axis's part
  const std::vector<State> states{{1e-7, 0, 0},        {2e-5, 1.9e-5, 0}, {1.9e-5, 2e-5, 0},
                                  {1.7e-5, 2e-5, 0},   {1e-6, 2e-5, 0},   {2e-5, 1.9e-5, 0.01},
                                  {1.8e-5, 2e-5, 0.01}};

  /// N, force of waves, of the deck's contact at S times the overlap.
  double force(const State& s, double stretch, const DeckUnits& units) const
  {
    const MpmContact c = contact(stretch, units);
    double kept[MpmContact::reversal_values] = {};
    const double r = r_eff / units.length, delta = stretch * s.delta / units.length,
                 delta_max = stretch * s.delta_max / units.length;
    const double k = c.response(r, delta, delta_max, s.impact_overlap, kept).stiffness;
    return c.radiation * k * k * (speed / units.length) * units.mass * units.length;
  }
};

TEST_F(Waves, ForceAndStiffnessAreThoseOfTheBranch)
{
  const MpmContact c = contact(1, {});
  for (const State& s : states) {
    double kept[MpmContact::reversal_values] = {};
    const Response found = c.response(r_eff, s.delta, s.delta_max, s.impact_overlap, kept);
    const double expected =
        answer(powder.curve, pair.mapping, r_eff, s.delta, s.delta_max, s.impact_overlap).stiffness;
    EXPECT_NEAR(found.stiffness, expected, 1e-12 * expected);
    EXPECT_EQ(found.force, c.force(r_eff, s.delta, s.delta_max, s.impact_overlap, kept));
  }
}

TEST_F(Waves, TakeTheSameShareOfAStretchedContact)
{
  for (const State& s : states) {
    const double real = force(s, 1, {}), stretch = 20;
    EXPECT_NEAR(force(s, stretch, {}), real / stretch, 1e-12 * real);  // as the law's own force
  }
}

TEST_F(Waves, AreTheSameInCgs)
{
  const DeckUnits cgs = DeckUnits::of("cgs", "here");
  EXPECT_NEAR(contact(1, cgs).radiation, pair.radiation * 1e-3, 1e-15 * pair.radiation);  // s^3/g
  for (const State& s : states) EXPECT_NEAR(force(s, 5, cgs), force(s, 5, {}), 1e-12 * force(s, 5, {}));
}

}  // namespace
}  // namespace granulaw::plugin
