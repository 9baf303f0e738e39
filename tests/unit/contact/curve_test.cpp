#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contact/contact.hpp"
#include "law_paths.hpp"
#include "synthetic_tables.hpp"

namespace granulaw::curve_test {

using tests::SyntheticTables;
using tests::unit_pair;

TEST(CurveTest, FollowsTheFunctionsOfItsTable)
{
  const SyntheticTables law;
  const Curve curve = law.curve();
  for (double x = 1e-9; x < law.end; x *= 1.013) {
    // 1e-6: cubics on an eighth of an octave
    EXPECT_NEAR(curve.loading(x).force / law.force(x), 1, 1e-6) << x;
    EXPECT_NEAR(curve.loading(x).radius / law.radius(x), 1, 1e-6) << x;
    EXPECT_NEAR(curve.kept(x), law.kept(x), 1e-5) << x;
    if (x > law.onset) {
      EXPECT_NEAR(curve.top(x).span, law.span(x), 1e-5) << x;
      EXPECT_NEAR(curve.top(x).share, law.hertz_share(x), 1e-5) << x;
      for (std::size_t j = 0; j < 3; ++j)  // 1e-3: linear between nodes
        EXPECT_NEAR(curve.unloading_radius(x).k[j], law.unloading_radius(x, j), 1e-3) << x;
    }
  }
}

/// The work returned is `kept`, whatever the shape of the unloading can do; its end is `span`, where it can.
TEST(CurveTest, ReturnsWhatItKeeps)
{
  const Curve curve = SyntheticTables{}.curve();
  for (double x = 1.0001 * curve.onset(); x < 1.2 * curve.end(); x *= 1.02) {
    const Reversal r = curve.reversal(x);
    EXPECT_NEAR(r.work(), curve.kept(x) * curve.work(x), 1e-13 * curve.work(x)) << x;
    EXPECT_NEAR(r.top(), curve.force(x), 1e-14 * r.top()) << x;
    EXPECT_NEAR(r.residual() / x, 1 - curve.top(x).span, 1e-12) << x;
    EXPECT_NEAR(r.work(r.x_max), r.work(), 1e-15);
    EXPECT_NEAR(r.work(r.residual()), 0, 1e-30);  // rounding of u
  }
}

TEST(CurveTest, ChangesTheSpanWhereNoUnloadingReturnsTheWork)
{
  CurveTable table = SyntheticTables{}.table();
  for (double& span : table.span.value) span = 1;
  for (double& slope : table.span.slope) slope = 0;
  ASSERT_FALSE(Curve::fault(table));
  const Curve curve(table);
  const double x = 0.05;
  const Reversal r = curve.reversal(x);
  EXPECT_NEAR(r.work(), curve.kept(x) * curve.work(x), 1e-13 * curve.work(x));
  EXPECT_GT(r.residual(), 0.1 * x);
  EXPECT_TRUE(r.shape().rises());
}

/// A cycle loses W - W_u, which never falls: no closed cycle gains.
TEST(CurveTest, LosesNoLessFurtherOn)
{
  const Curve curve = SyntheticTables{}.curve();
  double before = 0;
  for (double x = 0.5 * curve.onset(); x < 1.3 * curve.end(); x *= 1.001) {
    const double lost = curve.lost(x);
    EXPECT_GE(lost, before * (1 - 1e-14)) << x;
    before = lost;
  }
}

RC_GTEST_PROP(CurveProperty, StiffnessIsTheDerivativeOfTheForce, ())
{
  const Curve curve = SyntheticTables{}.curve();
  tests::stiffness_is_the_derivative(curve);
}

RC_GTEST_PROP(CurveProperty, IsHertzForSmallOverlapsOfEveryPair, ())
{
  const Curve curve = SyntheticTables{}.curve();
  const double e_s = *rc::gen::inRange(1, 1000) * 1e8, e_h = *rc::gen::inRange(1, 1000) * 1e8;
  const double r_eff = *rc::gen::inRange(1, 100) * 1e-4;
  const PairMapping pair = PairMapping::deformable_partner(e_s, e_h);
  const double delta = 1e-12 * r_eff;
  const double e_pair = 1.0 / (1.0 / e_s + 1.0 / e_h);
  const Answer force = answer(curve, pair, r_eff, delta, 0.0);
  // finite-sphere term 0.9 sqrt(x), at most 9e-7 here
  RC_ASSERT(std::abs(force.force / (4.0 / 3.0 * e_pair * std::sqrt(r_eff) * std::pow(delta, 1.5)) - 1) <
            2e-6);
  RC_ASSERT(std::abs(force.stiffness / (2.0 * e_pair * std::sqrt(r_eff * delta)) - 1) <
            1.2e-5);                                                                // the slope of a cubic
  RC_ASSERT(std::abs(force.contact_radius / std::sqrt(r_eff * delta) - 1) < 2e-6);  // cubics of the root
}

RC_GTEST_PROP(CurveProperty, LikePairIsAWallAtHalfTheOverlap, ())
{
  const Curve curve = SyntheticTables{}.curve();
  const double radius = 0.003, e_star = 1e10;
  const double wall_max = radius * std::pow(10.0, -*rc::gen::inRange(100, 500) / 100.0);
  const double wall_delta = wall_max * *rc::gen::inRange(1, 1500) / 1000.0;
  const Answer wall = answer(curve, PairMapping::rigid_partner(e_star), radius, wall_delta, wall_max);
  const Answer pair = answer(curve, PairMapping::deformable_partner(e_star, e_star),
                             effective_radius(radius, radius), 2 * wall_delta, 2 * wall_max);
  RC_ASSERT(std::abs(pair.force - wall.force) <= 1e-12 * wall.force);
  RC_ASSERT(std::abs(2 * pair.stiffness - wall.stiffness) <= 1e-12 * wall.stiffness);
  RC_ASSERT(std::abs(pair.contact_radius - wall.contact_radius) <= 1e-12 * wall.contact_radius);
  RC_ASSERT(std::abs(pair.delta_max - 2 * wall.delta_max) <= 1e-12 * wall.delta_max);
}

TEST(CurveTest, WorkFunctionsAreTheIntegralsOfTheForce)
{
  using boost::math::quadrature::gauss_kronrod;
  const Curve curve = SyntheticTables{}.curve();
  for (const double x : {1e-5, 5e-4, 6.4e-4, 7e-4, 3e-3, 0.02, 0.0999}) {
    // substitution x = s^4 makes the integrand smooth at 0; nodes are where its third derivative jumps
    const auto in_s = [&](double s) { return 4 * s * s * s * curve.loading(s * s * s * s).force; };
    const double loading = gauss_kronrod<double, 61>::integrate(in_s, 0.0, std::pow(x, 0.25), 15, 1e-12);
    EXPECT_NEAR(curve.work(x) / loading, 1.0, 1e-9) << x;
    const auto back = [&](double y) { return answer(curve, unit_pair, 1.0, y, x).force; };
    const double residual = x > curve.onset() ? curve.reversal(x).residual() : 0.0;
    const double unloading = gauss_kronrod<double, 61>::integrate(back, residual, x, 15, 1e-12);
    EXPECT_NEAR(curve.kept(x) * curve.work(x) / unloading, 1.0, 1e-9) << x;
  }
}

TEST(CurveTest, ContinuesLinearlyBeyondItsRangeAndSaysSo)
{
  const Curve curve = SyntheticTables{}.curve();
  const double end = curve.end();
  const auto at_end = curve.loading(end), beyond = curve.loading(1.5 * end);
  EXPECT_TRUE(curve.in_range(end));
  EXPECT_FALSE(curve.in_range(end * 1.0001));
  EXPECT_DOUBLE_EQ(beyond.stiffness, at_end.stiffness);
  EXPECT_NEAR(beyond.force, at_end.force + 0.5 * end * at_end.stiffness, 1e-14);
  EXPECT_NEAR(curve.work(1.5 * end), curve.work(end) + 0.5 * end * 0.5 * (at_end.force + beyond.force),
              1e-14);
  EXPECT_NEAR(curve.top(1.5 * end).span, curve.top(end).span, 1e-14);
}

TEST(CurveTest, IsContinuousAtNodesOnsetReversalPointAndEnd)
{
  const Curve curve = SyntheticTables{}.curve();
  std::vector<double> places = curve.table().nodes();
  places.front() *= 1.0001, places.back() = curve.end();  // below the first node Hertz, to 1e-6
  for (const double x : places) {
    const auto low = curve.loading(x * (1 - 1e-12)), high = curve.loading(x * (1 + 1e-12));
    EXPECT_NEAR(low.force, high.force, 1e-11 * low.force) << x;
    EXPECT_NEAR(low.stiffness, high.stiffness, 1e-9 * low.stiffness) << x;
    EXPECT_NEAR(low.radius, high.radius, 1e-11 * low.radius) << x;
  }
  const double x_m = 0.01;
  const Answer loading = answer(curve, unit_pair, 1.0, x_m, x_m);
  const Answer unloading = answer(curve, unit_pair, 1.0, x_m * (1 - 1e-12), x_m);
  EXPECT_NEAR(loading.force, unloading.force, 1e-10 * loading.force);
  EXPECT_NEAR(loading.contact_radius, unloading.contact_radius, 1e-10 * loading.contact_radius);
}

/// An end that is a node begins no interval of the table.
TEST(CurveTest, GoesOnWithoutAJumpWhereTheEndIsANode)
{
  SyntheticTables law;
  law.end = 128 * law.onset;
  for (const Curve& curve : {law.curve(), law.curve_with_axis(), SyntheticTables::elastic()})
    for (const double latched : {0.0, curve.axis() ? 0.4 * curve.end() : 0.0}) {
      const double x = curve.end(), below = x * (1 - 1e-12);
      const Curve::Loading at = curve.loading(x, latched), before = curve.loading(below, latched);
      // 1e-10: slopes times the step
      EXPECT_NEAR(at.force / before.force, 1, 1e-10);
      EXPECT_NEAR(at.stiffness / before.stiffness, 1, 1e-10);
      EXPECT_NEAR(at.radius / before.radius, 1, 1e-10);
      EXPECT_NEAR(curve.force(x, latched) / before.force, 1, 1e-10);
      EXPECT_NEAR(curve.work(x, latched) / curve.work(below, latched), 1, 1e-10);
      EXPECT_NEAR(curve.kept(x, latched) / curve.kept(below, latched), 1, 1e-10);
      const Reversal top = curve.reversal(x, latched), near = curve.reversal(below, latched);
      EXPECT_NEAR(top.force(0.97 * x) / near.force(0.97 * x), 1, 1e-9);
    }
}

TEST(CurveTest, ElasticBodyReturnsEverything)
{
  const Curve glass = SyntheticTables::elastic();
  EXPECT_EQ(glass.kept(0.01), 1);
  EXPECT_EQ(glass.lost(0.01), 0);
  EXPECT_DOUBLE_EQ(answer(glass, unit_pair, 1.0, 0.005, 0.01).force, glass.loading(0.005).force);
}

TEST(CurveTest, RefusesUnusableTables)
{
  const auto fault = [](auto change) {
    CurveTable table = SyntheticTables{}.table();
    change(table);
    return Curve::fault(table).what;
  };
  EXPECT_EQ(fault([](auto&) {}), "");
  EXPECT_EQ(fault([](auto& t) { t.force.value[3] = NAN; }), "'force' at node 3 is out of range");
  EXPECT_EQ(fault([](auto& t) { t.kept.slope[3] = INFINITY; }), "'kept_slope' at node 3 is out of range");
  EXPECT_EQ(fault([](auto& t) { t.span.value.pop_back(); }), "'span' has the wrong length");
  EXPECT_EQ(fault([](auto& t) { t.span.value[5] = 0; }), "'span' at node 5 is out of range");
  EXPECT_EQ(fault([](auto& t) { t.hertz_share.value[5] = -0.01; }),
            "'hertz_share' at node 5 is out of range");
  EXPECT_EQ(fault([](auto& t) { t.unloading_radius.pop_back(); }), "'unloading_radius' has the wrong length");
  EXPECT_EQ(fault([](auto& t) { t.unloading_radius[3][1] = 11; }), "'unloading_radius' is out of range");
  EXPECT_EQ(fault([](auto& t) { t.unloading_radius.clear(); }), "");  // older files
  EXPECT_EQ(fault([](auto& t) { t.end = 0; }), "'end' is out of range");
  EXPECT_EQ(fault([](auto& t) { t.onset = NAN; }), "'onset' is out of range");
  EXPECT_EQ(fault([](auto& t) { t.octaves = 1000; }), "'octaves' is out of range");
  EXPECT_EQ(fault([](auto& t) { t.end *= 2; }), "'force' has the wrong length");
  EXPECT_EQ(fault([](auto& t) { t.force.value[9] = 1.1 * t.force.value[10]; }),
            "'force' falls between nodes 9 and 10");
}

/// A closed cycle would gain where `kept` rises: at a node, or between two by its slopes.
TEST(CurveTest, RefusesAGainOfEnergy)
{
  CurveTable table = SyntheticTables{}.table();
  table.kept.value[20] = 1.01 * table.kept.value[19];
  EXPECT_EQ(Curve::fault(table).what, "'kept' rises between nodes 19 and 20");
  table = SyntheticTables{}.table();
  table.kept.slope[20] *= 20;
  EXPECT_EQ(Curve::fault(table).what, "'kept' rises between nodes 19 and 20");
}

}  // namespace granulaw::curve_test
