#include "base/larger.hpp"
#include "deck/soften.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "deck/hertz.hpp"
#include "deck/plan.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck::soften_test {

using DeckSoften = Deck;

TEST_F(DeckSoften, AStretchedDeckHasLongerStepsAndTheSameOverlapsInItsLaw)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const Scene plain = falling();
  Scene stretched = plain;
  stretched.stretch = 4;
  stretched.time_step *= 4;
  const Plan a = make_plan(plain, options), b = make_plan(stretched, options);
  EXPECT_DOUBLE_EQ(b.time_step, 4 * a.time_step);
  EXPECT_DOUBLE_EQ(b.depth, a.depth);
  const Visited run = read_visited(write(
      "run.json",
      R"({"pair": {"contacts_begun": 9, "impact_speed_max_m_per_s": 0.01, "overlap_over_radius_max": 0.6},
                      "wall": {"contacts_begun": 0, "impact_speed_max_m_per_s": 0}})"));
  EXPECT_DOUBLE_EQ(make_plan(stretched, options, &run).pairs[0].overlap, visited_margin * 0.6 / 4);
  // another stretch takes the place of the deck's
  const SoftenLimits limits{0.5, 10, 1e6, 0.01, 0.6};
  const Softening once = soften(plain, a, options, limits), again = soften(stretched, b, options, limits);
  EXPECT_DOUBLE_EQ(again.stretch, once.stretch);
  EXPECT_DOUBLE_EQ(again.time_step, once.time_step);
}

TEST_F(DeckSoften, SoftensWithinEachLimit)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  const Scene s = falling();
  const Plan plan = make_plan(s, options);
  SoftenLimits limits{0.5, 10, 1e6, 0.01, 0.6};
  const auto all = [&] { return soften(s, plan, options, limits); };
  const Softening by_overlap = all();
  EXPECT_LE(by_overlap.overlap, 0.5);
  EXPECT_GT(1.1 * by_overlap.overlap, 0.5);  // two digits of s
  EXPECT_DOUBLE_EQ(by_overlap.time_step, by_overlap.stretch * plan.time_step);  // whatever the deck has
  limits.static_load = 0.05;
  const Softening by_static = all();
  EXPECT_TRUE(by_static.stretch == 1 || by_static.static_ratio <= 0.05) << by_static.static_ratio;
  EXPECT_LE(by_static.stretch, by_overlap.stretch);
  limits = {0.5, 0.001, 1e6, 0.01, 0.6};
  EXPECT_EQ(all().stretch, 1);  // never below: the law itself
  ASSERT_FALSE(by_overlap.naive.empty());
  EXPECT_GT(by_overlap.naive[0].e_naive, by_overlap.naive[0].e);  // a softer sphere yields less
}

/// Each number by its definition in soften.hpp, for spheres of R = 2 mm and wax that yields.
TEST_F(DeckSoften, SoftenStatesItsNumbers)
{
  PlanOptions options;
  options.materials[1] = {"wax", 1000, 91e6, 0.3, 1e6, 0};
  options.materials[2] = {"steel", 7800, 210e9, 0.3, 1e9, 0};
  const Scene s = falling();
  const Plan plan = make_plan(s, options);
  const double r = 0.002, d = 2 * r, g = 9.81, rho = 1000, ball = 4.0 / 3.0 * M_PI * r * r * r;
  const double rounding = 1e-12;
  SoftenLimits limits{0.3, 0.2, 1e6, 0, 0.6};
  const Softening own = soften(s, plan, options, limits);
  EXPECT_NEAR(own.fill_height / (100 * ball / 0.6 / 4), 1, rounding);  // 100 spheres on 2 m by 2 m
  EXPECT_NEAR(own.flow_time / std::sqrt(d / g), 1, rounding);
  ASSERT_EQ(own.pairs.size(), 2u);
  for (const PairStretch& q : own.pairs) {
    const double r_eff = q.pair->meeting.wall ? r : r / 2, m_eff = r_eff / r * rho * ball;
    const double speed = std::sqrt(2 * g * d), e_star = q.pair->meeting.mapping.e_star_pair();
    EXPECT_NEAR(q.slow_speed / speed, 1, rounding);  // a fall through one diameter
    EXPECT_NEAR(q.contact_time / hertz_time(e_star, r_eff, m_eff, speed), 1, rounding);
    EXPECT_NEAR(q.by_time / (0.2 * own.flow_time / q.contact_time), 1, rounding);
    EXPECT_NEAR(q.by_overlap / (0.3 / q.pair->overlap), 1, rounding);
    EXPECT_NEAR(q.static_load / (0.6 * rho * g * own.fill_height * d * d), 1, rounding);
    EXPECT_NEAR(q.by_static / (1e6 * q.yield_load / q.static_load), 1, rounding);
    // Hertz at the onset: the largest contact pressure 3 F/(2 pi a^2), a^2 = R* delta, is C(nu) Y
    const double force_per_area = 3 * q.yield_load / (2 * M_PI * r_eff);
    const double overlap = std::pow(q.yield_load / (4.0 / 3.0 * e_star * std::sqrt(r_eff)), 2.0 / 3.0);
    EXPECT_NEAR(force_per_area / overlap / (1.295 * std::exp(0.736 * 0.3) * 1e6), 1, rounding);
  }
  // a bed so high that its bottom yields: the set is the load beyond yield over pi p_y R*, p_y = 1.6 Y, over
  // R*
  limits = {0.5, 10, 1e6, 20, 0.6};
  const Softening high = soften(s, plan, options, limits);
  double ratio = 0, set = 0;
  for (const PairStretch& q : high.pairs) {
    const double r_eff = q.pair->meeting.wall ? r : r / 2, load = high.stretch * q.static_load;
    ratio = larger(ratio, load / q.yield_load);
    set = larger(set, high.stretch * (load - q.yield_load) / (M_PI * 1.6 * 1e6 * r_eff * r_eff));
  }
  ASSERT_GT(ratio, 1);
  EXPECT_NEAR(high.static_ratio / ratio, 1, rounding);
  EXPECT_NEAR(high.extra_set / set, 1, rounding);
  // the stretch is the smallest bound, rounded down to two digits
  for (double overlap = 0.2; overlap < 0.4; overlap *= 1.003) {
    limits = {overlap, 10, 1e6, 0.01, 0.6};
    const Softening at = soften(s, plan, options, limits);
    const double bound = std::min(at.pairs[0].by_overlap, at.pairs[1].by_overlap);
    ASSERT_GT(bound, 1);
    EXPECT_LE(at.stretch, bound * (1 + 1e-11))
        << overlap;  // a bound of two digits itself is not rounded: 1e-12
    EXPECT_GT(at.stretch * 1.1, bound) << overlap;
    const double digits = at.stretch / std::pow(10.0, std::floor(std::log10(at.stretch * (1 + 1e-9))) - 1);
    EXPECT_NEAR(digits, std::round(digits), 1e-9) << overlap;
  }
}

}  // namespace granulaw::deck::soften_test
