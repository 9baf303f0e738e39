// Which runs a law is still missing, from records alone.
#include "characterise/run/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "characterise/run/sampling_plan.hpp"
#include "characterise/build/verification.hpp"

namespace granulaw::refinement_test {

constexpr double tolerance = 0.01;

/// Runs at these overlaps, all predicted as measured.
std::vector<LeftOutRun> runs_at(const std::vector<double>& overlaps)
{
  std::vector<LeftOutRun> runs;
  for (const double x : overlaps) runs.push_back({std::log(x), x, {x, 0.8}, AtReversal{x, 0.8}});
  return runs;
}

TEST(Refinement, BisectsBothIntervalsOfARunThatIsMissed)
{
  std::vector<LeftOutRun> runs = runs_at({0.001, 0.004, 0.016, 0.064});
  EXPECT_TRUE(bisections(runs, tolerance).empty());
  runs[1].predicted->restitution *= 1.02;  // e ...
  std::vector<double> wanted = bisections(runs, tolerance);
  ASSERT_EQ(wanted.size(), 2u);
  EXPECT_NEAR(std::exp(wanted[0]), 0.002, 1e-9);
  EXPECT_NEAR(std::exp(wanted[1]), 0.008, 1e-9);
  runs = runs_at({0.001, 0.004, 0.016, 0.064});
  runs[1].predicted->force *= 0.98;  // ... and F alike
  EXPECT_EQ(bisections(runs, tolerance), wanted);
  runs[2].predicted->force *= 1.02;  // an interval is bisected once
  EXPECT_EQ(bisections(runs, tolerance).size(), 3u);
}

TEST(Refinement, AnIntervalThatHidesLessThanTheToleranceIsLeftAlone)
{
  const double width = least_interval(tolerance);
  EXPECT_NEAR(width * width / 8, tolerance, 1e-12);
  std::vector<LeftOutRun> runs = runs_at({0.01, 0.01 * std::exp(0.99 * width), 0.1});
  runs[0].predicted->force *= 1.5;
  EXPECT_TRUE(bisections(runs, tolerance).empty());
}

TEST(Refinement, WhatHasNoPredictionOrNoForceIsNotMissed)
{
  std::vector<LeftOutRun> runs = runs_at({0.001, 0.01, 0.1});
  runs[2].predicted.reset();
  runs[1].measured.force = 0;
  EXPECT_EQ(largest_miss(runs), 0);
}

TEST(Refinement, AnEBelowAHalfCountsOverAHalf)
{
  EXPECT_EQ(counted(0, 0.02, 0.8), 0.02);
  EXPECT_DOUBLE_EQ(counted(0, 0.02, 0.25), 0.01);
}

TEST(Refinement, InertiaIsKnownAtStandstill)
{
  std::vector<LeftOutRun> runs{{0.06, 0.03, {1, 0.5}, AtReversal{1.05, 0.5}}, {0.12, 0.06, {1, 0.4}, {}}};
  EXPECT_EQ(bisections(runs, tolerance, Exact{0, 0.025}), (std::vector{0.03, 0.09}));
  EXPECT_EQ(bisections(runs, tolerance, Exact{0, 0.035}), (std::vector{0.09}));  // as slow as a press
  EXPECT_EQ(bisections(runs, tolerance), (std::vector{0.09}));         // a rate: nothing is known below
}

/// Impacts whose velocity effects are these functions of the speed.
template <class Force, class Dissipation>
std::vector<LeftOutRun> impacts_left_out(const std::vector<double>& speeds, AxisTable::By kind,
                                         const Force& force, const Dissipation& dissipation)
{
  std::vector<ContactRecords::Impact> impacts;
  std::vector<LawShape::VelocityEffect> effects;
  for (const double v : speeds) {
    ContactRecord path;
    path.depth = 0.5 * v, path.work_ratio = 0.25;
    impacts.push_back({v, path});
    effects.push_back({v, 0, dissipation(v), 0, {force(v)}});
  }
  return leave_out_fast(impacts, effects, kind);
}

TEST(Refinement, EffectsThatGoAsTheDamageNumberAreNotMissed)
{
  const auto square = [](double v) { return 2 * v * v; };
  const auto runs = impacts_left_out({0.0625, 0.125, 0.25}, AxisTable::By::inertia, square, square);
  EXPECT_NEAR(largest_miss(runs), 0, 1e-12);
  EXPECT_FALSE(runs.back().predicted);
  const auto bump = [&](double v) { return square(v) + (v == 0.125 ? 0.03 : 0); };
  const auto missed = impacts_left_out({0.0625, 0.125, 0.25}, AxisTable::By::inertia, bump, square);
  EXPECT_NEAR(missed[1].predicted->force / missed[1].measured.force, std::exp(-0.03), 1e-3);
  EXPECT_EQ(bisections(missed, tolerance, Exact{0, 0.04}).size(), 2u);  // not below 0.04
}

TEST(Refinement, ARateGoesByTheLogarithmOfTheSpeed)
{
  const std::vector<double> speeds = first_rate_speeds(0.005, 0.25);
  const auto log = [](double v) { return 0.03 * std::log(v); };
  const auto runs = impacts_left_out(speeds, AxisTable::By::rate, log, log);
  EXPECT_NEAR(largest_miss(runs), 0, 1e-12);
  EXPECT_FALSE(runs.front().predicted);  // slower ones are not known
  EXPECT_TRUE(runs[1].predicted);
}

/// A run is left out whole, a press with all its reversal points; the deepest is not.
TEST(Refinement, ARunIsLeftOutWhole)
{
  ContactRecords records;
  const auto add = [&](int run, double depth, double run_depth) {
    ContactRecord record;
    record.depth = depth, record.work_ratio = 0.25, record.run = run, record.run_depth = run_depth;
    records.slow.push_back(record);
  };
  add(0, 0.001, 0.001), add(1, 0.004, 0.016), add(1, 0.008, 0.016), add(1, 0.016, 0.016);
  add(2, 0.05, 0.2), add(2, 0.2, 0.2);
  std::vector<std::size_t> left;
  const auto shape = [&](const ContactRecords& others) {
    left.push_back(others.slow.size());
    return LawShape::zero();
  };
  const std::vector<LeftOutRun> runs = leave_out_slow(records, shape, 5e-4, 0.2, 3);
  EXPECT_EQ(left, (std::vector<std::size_t>{5, 3}));
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_FALSE(runs.back().predicted);
  EXPECT_NEAR(runs[1].predicted->restitution, 1, 1e-12);
  EXPECT_NEAR(runs[1].predicted->force, std::pow(0.016, 1.5), 1e-12);
  EXPECT_FALSE(leave_out_slow(records, shape, 5e-4, 0.2, 4).front().predicted);  // too few for a fit of the others
}

/// A guide is exact at the onset: a missed first run is followed by one half-way to it, not nearer than may be run.
TEST(Refinement, BisectsBelowTheFirstRunWhereALawIsExact)
{
  std::vector<LeftOutRun> runs = runs_at({0.004, 0.016});
  runs[0].predicted->force *= 1.02;
  const double onset = std::log(0.001);
  const std::vector<double> wanted = bisections(runs, tolerance, Exact{onset, std::log(0.00125)});
  ASSERT_EQ(wanted.size(), 2u);
  EXPECT_NEAR(std::exp(wanted[0]), 0.002, 1e-12);
  EXPECT_EQ(bisections(runs, tolerance, Exact{onset, std::log(0.0021)}).size(), 1u);
}

TEST(FirstOverlaps, BeginAtThreeOnsetsOrWhereRunsGetDear)
{
  EXPECT_NEAR(first_overlaps(1e-3, 0.1, true).front(), 3e-3, 1e-12);
  EXPECT_NEAR(first_overlaps(1e-6, 0.1, true).front(), 5e-4, 1e-12);
  EXPECT_NEAR(first_overlaps(1e-3, 0.1, false).front(), 2e-3, 1e-12);
  for (const bool guided : {true, false}) {
    const std::vector<double> overlaps = first_overlaps(1e-3, 0.1, guided);
    EXPECT_EQ(overlaps.back(), 0.1);
    for (std::size_t k = 1; k < overlaps.size(); ++k)
      EXPECT_LE(overlaps[k] / overlaps[k - 1], (guided ? 4 : 2.5) + 1e-9);
  }
}

TEST(FirstSpeeds, AreHalvesOfTheFastestAsFarAsInertiaCounts)
{
  EXPECT_EQ(first_inertia_speeds(0.25, tolerance), (std::vector{0.0625, 0.125, 0.25}));
  EXPECT_EQ(first_inertia_speeds(0.1, tolerance), (std::vector{0.05, 0.1}));
  EXPECT_EQ(first_inertia_speeds(0.03, tolerance), (std::vector{0.03}));
}

/// One press serves the overlaps down to a quarter of its depth; impacts reach those where they are slow enough:
/// .49 sqrt(I) R.
TEST(SlowRuns, ShareAPressWhereItsContactIsResolved)
{
  const CharacterisedBody body = characterised_body_of(100, 0.3, 0);
  const std::vector<double> overlaps{5e-4, 0.008, 0.012, 0.03, 0.06};
  const SamplingPlan plan = slow_runs_to(overlaps, body, tolerance, 34, 0.02);
  ASSERT_EQ(plan.presses.size(), 2u);
  EXPECT_EQ(plan.presses[0].depth, 0.06);
  EXPECT_EQ(plan.presses[0].stops, (std::vector{0.03}));
  EXPECT_EQ(plan.presses[0].resolution, 34);
  EXPECT_EQ(plan.presses[1].depth, 0.012);
  EXPECT_EQ(plan.slow_impacts.size(), 2u);
  EXPECT_EQ(slow_runs_to(overlaps, body, tolerance, 34, 0.1).slow_impacts.size(), 4u);
}

TEST(Verification, StandsHalfWayBetweenTheRuns)
{
  const auto impacts = [](const std::vector<double>& speeds) {
    std::vector<ContactRecords::Impact> all;
    for (const double v : speeds) all.push_back({v, {}});
    return all;
  };
  EXPECT_EQ(verification_speeds(impacts({0.1, 0.2}), 0.2, AxisTable::By::inertia, 3),
            (std::vector{0.05, 0.15000000000000002}));
  // five intervals, three of which are looked at
  EXPECT_EQ(verification_speeds(impacts({1, 2, 3, 4, 5}), 5, AxisTable::By::inertia, 3),
            (std::vector{0.5, 2.5, 4.5}));
  const auto rate = verification_speeds(impacts({0.01, 0.04, 0.16}), 0.16, AxisTable::By::rate, 4);
  ASSERT_EQ(rate.size(), 2u);
  EXPECT_NEAR(rate[0], 0.02, 1e-12);
}

}  // namespace granulaw::refinement_test
