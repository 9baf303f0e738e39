// Changes of a curve by the speed of an impact.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "law_paths.hpp"
#include "synthetic_tables.hpp"

namespace granulaw::axis_test {

using tests::SyntheticTables;

/// X of a level, between levels, or below the first.
double any_latched(const Curve& curve)
{
  return curve.axis()->level.back() * *rc::gen::inRange(1, 1001) / 1000.0;
}

TEST(AxisTest, AtALevelItHasTheLevelsNumbers)
{
  const SyntheticTables law;
  const Curve curve = law.curve_with_axis();
  const AxisTable& axis = *curve.axis();
  const std::size_t nodes = axis.shares();
  for (std::size_t k = 0; k < axis.level.size(); ++k) {
    const double latched = axis.level[k];
    EXPECT_NEAR(curve.kept(latched, latched), axis.kept[k], 1e-12);
    EXPECT_NEAR(curve.top(latched, latched).span, axis.span[k], 1e-12);
    for (std::size_t l = 1; l < nodes; ++l) {
      const double x = axis.share_spacing() * static_cast<double>(l) * latched;
      EXPECT_NEAR(curve.force(x, latched) / curve.force(x), 1 + axis.force.value[k * nodes + l], 1e-12);
    }
  }
}

TEST(AxisTest, ChangesNothingWithoutSpeedAndFarBeyondTheImpact)
{
  const Curve with = SyntheticTables{}.curve_with_axis(), without = SyntheticTables{}.curve();
  for (double x = 1e-6; x < 0.1; x *= 1.1) {
    EXPECT_EQ(with.force(x), without.force(x));
    EXPECT_NEAR(with.kept(x), without.kept(x), 1e-6);  // cubics of its logarithm
    const double latched = x / 1.6;
    EXPECT_EQ(with.force(x, latched), with.force(x));
    EXPECT_NEAR(with.work(x, latched) - with.work(x),
                with.work(1.5 * latched, latched) - with.work(1.5 * latched), 1e-12 * with.work(x));
  }
}

RC_GTEST_PROP(AxisProperty, StiffnessIsTheDerivativeOfTheForce, ())
{
  const Curve curve = SyntheticTables{}.curve_with_axis();
  tests::stiffness_is_the_derivative(curve, any_latched(curve));
}

/// At the levels the work of loading is the integral of the force; between them its mean is interpolated.
TEST(AxisTest, WorkIsTheIntegralOfTheForce)
{
  const Curve curve = SyntheticTables{}.curve_with_axis();
  for (const double latched : curve.examined_levels()) {
    tests::Path path(curve, latched);
    for (const double share : {0.1, 0.3, 0.6, 1.0, 1.4, 2.0}) {
      path.move(share * latched);
      EXPECT_NEAR(path.work() / curve.work(share * latched, latched), 1, 5e-4) << latched << ' ' << share;
    }
  }
  const double level = curve.axis()->level[4];
  tests::Path path(curve, level);
  path.move(0.6 * level);  // a node of the table: 24 intervals to 1.5
  path.move(1.25 * level);
  EXPECT_NEAR(path.work() / curve.work(1.25 * level, level), 1, 1e-5);
}

RC_GTEST_PROP(AxisProperty, NoClosedCycleGainsEnergy, ())
{
  const Curve curve = SyntheticTables{}.curve_with_axis();
  // half of the least loss: what the table of the work may be off
  tests::no_closed_cycle_gains(curve, any_latched(curve), 0.5 * Curve::least_loss);
}

TEST(AxisTest, LosesNoLessFurtherOn)
{
  const Curve curve = SyntheticTables{}.curve_with_axis();
  for (int k = 1; k <= 60; ++k) {
    const double latched = curve.axis()->level.back() * k / 60;
    double before = 0;
    for (double x = 0.5 * curve.onset(); x < 1.3 * curve.end(); x *= 1.002) {
      const double lost = curve.lost(x, latched);
      EXPECT_GE(lost, before - 1e-4 * curve.work(x, latched)) << x << ' ' << latched;
      before = lost;
    }
  }
}

/// A contact that reverses before its X loses in the ratio of the press's losses; beyond X it loses more than
/// the press by what it did at X.
TEST(AxisTest, LosesInTheRatioOfThePress)
{
  const Curve curve = SyntheticTables{}.curve_with_axis();
  const double latched = curve.axis()->level[5];
  const auto loss = [&](double x, double at) { return -std::log(curve.kept(x, at)); };
  const double ratio = loss(latched, latched) / loss(latched, 0);
  for (const double share : {0.1, 0.4, 0.8})
    EXPECT_NEAR(loss(share * latched, latched), ratio * loss(share * latched, 0), 1e-12);
  const double more = loss(latched, latched) - loss(latched, 0);
  EXPECT_NEAR(loss(1.3 * latched, latched), loss(1.3 * latched, 0) + more, 1e-12);
}

TEST(AxisTest, ReachesFurtherWithSpeedAndNoFurtherThanItsEnd)
{
  const SyntheticTables law;
  const Curve inertia = law.curve_with_axis(), rate(law.table(), law.rate_axis(1e-3));
  EXPECT_EQ(inertia.reach(-1), 0);
  EXPECT_EQ(inertia.reach(0), 0);
  EXPECT_NEAR(inertia.reach(0.1225), 0.1 * 0.5 * 0.8, 1e-15);
  EXPECT_EQ(inertia.reach(7), inertia.axis()->reach.value.back());
  EXPECT_EQ(law.curve().reach(0.1), 0);
  EXPECT_GT(rate.reach(1e-6), 0);
  EXPECT_EQ(rate.reach(1e-6), rate.reach(rate.axis()->speed_begin));
  // below the first level a rate's law is that of the first
  const double first = rate.axis()->level.front();
  EXPECT_NEAR(rate.force(0.3 * first, 0.5 * first) / rate.force(0.3 * first),
              1 + (rate.force(0.6 * first, first) / rate.force(0.6 * first) - 1), 1e-12);
}

TEST(AxisTest, RefusesUnusableTables)
{
  const SyntheticTables law;
  const auto fault = [&](auto change) {
    AxisTable axis = law.rate_axis(1e-3);
    change(axis);
    const CurveTable table = law.table();
    return Curve::fault(table, &axis).what;
  };
  EXPECT_EQ(fault([](auto&) {}), "");
  EXPECT_EQ(fault([](auto& a) { a.reach.value[3] = NAN; }), "'reach' at node 3 is out of range");
  EXPECT_EQ(fault([](auto& a) { a.reach.value[4] = a.reach.value[2]; }),
            "'reach' falls between nodes 3 and 4");
  EXPECT_EQ(fault([](auto& a) { a.level[3] = a.level[2]; }), "'level' does not rise after node 2");
  EXPECT_EQ(fault([](auto& a) { a.kept[0] = 1.1; }), "'kept' at node 0 is out of range");
  EXPECT_EQ(fault([](auto& a) { a.span.clear(); }), "'span' has the wrong length");
  EXPECT_EQ(fault([](auto& a) { a.speed_begin = 1; }), "'speed_begin' is out of range");
  EXPECT_EQ(fault([](auto& a) { a.reference_radius = 0; }), "'reference_radius' is out of range");
  EXPECT_EQ(fault([](auto& a) { a.force.value[24] = 0.1; }),
            "'force' of level 0 does not end at 0 with slope 0");
  EXPECT_NE(
      fault([](auto& a) { a.force.value[30] = 9, a.force.slope[30] = 0; }).find("the loading force falls"),
      std::string::npos);
  EXPECT_EQ(fault([](auto& a) { a.level.back() *= 1.01; }), "the last 'level' is not the last 'reach'");
}

}  // namespace granulaw::axis_test
