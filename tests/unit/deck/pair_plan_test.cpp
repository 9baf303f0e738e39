#include "deck/pair_plan.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck::pair_plan_test {

using DeckPairPlan = Deck;

TEST_F(DeckPairPlan, HertzSufficesBelowTheOnset)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const double onset = onset_velocity(1e8, 1e6, 1000, 0.3);
  for (const double factor : {0.999, 1.001}) {
    options.speed = factor * onset;
    const Plan plan = make_plan(falling(), options);
    EXPECT_NEAR(plan.pairs[1].onset / onset, 1, 1e-12);
    EXPECT_NEAR(plan.pairs[0].onset / onset, 2, 1e-12);  // each sphere of a pair takes half of the speed
    EXPECT_EQ(plan.pairs[1].needs_table, factor > 1);
    EXPECT_FALSE(plan.pairs[0].needs_table);
    EXPECT_EQ(table_command(plan, "m.toml").empty(), factor < 1);
  }
}

TEST_F(DeckPairPlan, TakesWhatWasVisited)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const Scene s = falling();
  const std::string both =
      R"("pair": {"contacts_begun": 9, "impact_speed_max_m_per_s": 1.0, "overlap_over_radius_max": 0.5},
                              "wall": {"contacts_begun": 0, "impact_speed_max_m_per_s": 0})";
  const Visited old = read_visited(write("old.json", "{" + both + "}"));
  const Plan plan = make_plan(s, options, &old);
  EXPECT_DOUBLE_EQ(plan.pairs[0].speed, visited_margin);
  EXPECT_DOUBLE_EQ(plan.pairs[0].overlap, 0.5 * visited_margin);
  EXPECT_FALSE(plan.pairs[1].visited);
  EXPECT_NE(table_command(plan, "m.toml").find("wax:wall"), std::string::npos);  // the plug-in requires it all the same
  const Visited now = read_visited(write(
      "now.json", "{" + both + R"(, "pairs": [{"kind": "rigid wall", "types": [1, 2], "contacts_begun": 3,
                                          "impact_speed_max_m_per_s": 0.4}]})"));
  const Plan by_pair = make_plan(s, options, &now);
  EXPECT_FALSE(by_pair.pairs[0].visited);
  EXPECT_DOUBLE_EQ(by_pair.pairs[1].speed, 0.4 * visited_margin);
  EXPECT_THROW(read_visited(write("bad.json", "[1")), Error);
  EXPECT_THROW(read_visited(write("none.json", "{}")), Error);
}

}  // namespace granulaw::deck::pair_plan_test
