#include "law/contact_curve.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "base/error.hpp"
#include "law_paths.hpp"
#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::sample_table;
using testing::SyntheticLaw;
using testing::unit_pair;

TEST(ContactCurve, ReproducesCubicsBetweenItsNodes)
{
  const auto g = [](double s) { return 1.0 + 0.3 * s - 0.8 * s * s + 0.5 * s * s * s; };
  const auto rho = [](double s) { return 0.9 * s * s; };
  const auto n = [](double s) { return 1.5 - 0.1 * s * s * s; };
  const auto hertz_share = [](double s) { return 1.0 + 0.5 * s * s - s * s * s; };
  const auto a = [](double s) { return 1.0 + s; };
  const ContactCurve curve(sample_table(0.6, 0.0, 7, g, rho, n, hertz_share, a), "test");
  for (int k = 1; k < 100; ++k) {
    const double s = 0.6 * k / 100, x = s * s * s * s;
    // 1e-9: sample_table's finite-difference slopes
    EXPECT_NEAR(curve.loading(x).force, std::pow(x, 1.5) * g(s), 1e-9 * std::pow(x, 1.5));
    EXPECT_NEAR(curve.loading(x).radius, std::sqrt(x) * a(s), 1e-9 * std::sqrt(x));
    EXPECT_NEAR(curve.reversal(x).residual, x * rho(s), 1e-9 * x);
    EXPECT_NEAR(curve.reversal(x).shape.exponent, n(s), 1e-9);
    EXPECT_NEAR(curve.reversal(x).shape.hertz_share, hertz_share(s), 1e-9);
  }
}

RC_GTEST_PROP(ContactCurve, StiffnessIsTheDerivativeOfTheForce, ())
{
  const ContactCurve curve = SyntheticLaw{}.curve();
  testing::stiffness_is_the_derivative(curve, curve);
}

RC_GTEST_PROP(ContactCurve, IsHertzForSmallOverlapsOfEveryPair, ())
{
  const ContactCurve curve = SyntheticLaw{}.curve();
  const double e_s = *rc::gen::inRange(1, 1000) * 1e8, e_h = *rc::gen::inRange(1, 1000) * 1e8;
  const double r_eff = *rc::gen::inRange(1, 100) * 1e-4;
  const PairMapping pair = PairMapping::deformable_partner(e_s, e_h);
  const double delta = 1e-12 * r_eff;
  const double e_pair = 1.0 / (1.0 / e_s + 1.0 / e_h);
  const ContactForce force = curve.evaluate(pair, r_eff, delta, 0.0);
  // finite-sphere term 0.9 sqrt(x), at most 9e-7 here
  RC_ASSERT(std::abs(force.force / (4.0 / 3.0 * e_pair * std::sqrt(r_eff) * std::pow(delta, 1.5)) - 1) <
            2e-6);
  RC_ASSERT(std::abs(force.stiffness / (2.0 * e_pair * std::sqrt(r_eff * delta)) - 1) < 2e-6);
  RC_ASSERT(std::abs(force.contact_radius / std::sqrt(r_eff * delta) - 1) < 1e-12);
}

RC_GTEST_PROP(ContactCurve, LikePairIsAWallAtHalfTheOverlap, ())
{
  const ContactCurve curve = SyntheticLaw{}.curve();
  const double radius = 0.003, e_star = 1e10;
  const double wall_max = radius * std::pow(10.0, -*rc::gen::inRange(100, 500) / 100.0);
  const double wall_delta = wall_max * *rc::gen::inRange(1, 1500) / 1000.0;
  const ContactForce wall = curve.evaluate(PairMapping::rigid_partner(e_star), radius, wall_delta, wall_max);
  const ContactForce pair = curve.evaluate(PairMapping::deformable_partner(e_star, e_star),
                                           effective_radius(radius, radius), 2 * wall_delta, 2 * wall_max);
  RC_ASSERT(std::abs(pair.force - wall.force) <= 1e-12 * wall.force);
  RC_ASSERT(std::abs(2 * pair.stiffness - wall.stiffness) <= 1e-12 * wall.stiffness);
  RC_ASSERT(std::abs(pair.contact_radius - wall.contact_radius) <= 1e-12 * wall.contact_radius);
  RC_ASSERT(std::abs(pair.delta_max - 2 * wall.delta_max) <= 1e-12 * wall.delta_max);
}

TEST(ContactCurve, WorkFunctionsAreTheIntegralsOfTheForce)
{
  using boost::math::quadrature::gauss_kronrod;
  const ContactCurve curve = SyntheticLaw{}.curve();
  for (const double x : {1e-5, 5e-4, 6.4e-4, 7e-4, 3e-3, 0.02, 0.0999}) {
    // substitution x = s^4 makes the integrand smooth at 0; nodes are where its third derivative jumps
    const auto in_s = [&](double s) { return 4 * s * s * s * curve.loading(s * s * s * s).force; };
    const double loading = gauss_kronrod<double, 61>::integrate(in_s, 0.0, std::pow(x, 0.25), 15, 1e-12);
    EXPECT_NEAR(curve.work_loading(x) / loading, 1.0, 1e-9) << x;
    const auto back = [&](double y) { return curve.evaluate(unit_pair, 1.0, y, x).force; };
    const double residual = x > curve.onset() ? curve.reversal(x).residual : 0.0;
    const double unloading = gauss_kronrod<double, 61>::integrate(back, residual, x, 15, 1e-12);
    EXPECT_NEAR(curve.work_unloading(x) / unloading, 1.0, 1e-9) << x;
  }
}

TEST(ContactCurve, ContinuesLinearlyBeyondItsRangeAndSaysSo)
{
  const ContactCurve curve = SyntheticLaw{}.curve();
  const double end = curve.x_end();
  const auto at_end = curve.loading(end), beyond = curve.loading(1.5 * end);
  EXPECT_TRUE(curve.in_range(end));
  EXPECT_FALSE(curve.in_range(end * 1.0001));
  EXPECT_DOUBLE_EQ(beyond.stiffness, at_end.stiffness);
  EXPECT_NEAR(beyond.force, at_end.force + 0.5 * end * at_end.stiffness, 1e-14);
  EXPECT_NEAR(curve.work_loading(1.5 * end),
              curve.work_loading(end) + 0.5 * end * 0.5 * (at_end.force + beyond.force), 1e-14);
  EXPECT_NEAR(curve.reversal(1.5 * end).residual / (1.5 * end), curve.reversal(end).residual / end, 1e-14);
}

TEST(ContactCurve, IsContinuousAtNodesOnsetReversalPointAndEnd)
{
  const ContactCurve curve = SyntheticLaw{}.curve(17);
  std::vector<double> places{curve.onset(), curve.x_end()};
  for (int k = 1; k < 16; ++k) places.push_back(std::pow(curve.table().s_end * k / 16, 4));
  for (const double x : places) {
    const auto low = curve.loading(x * (1 - 1e-12)), high = curve.loading(x * (1 + 1e-12));
    EXPECT_NEAR(low.force, high.force, 1e-11 * low.force) << x;
    EXPECT_NEAR(low.stiffness, high.stiffness, 1e-9 * low.stiffness) << x;
    EXPECT_NEAR(low.radius, high.radius, 1e-11 * low.radius) << x;
  }
  const double x_m = 0.01;
  const ContactForce loading = curve.evaluate(unit_pair, 1.0, x_m, x_m);
  const ContactForce unloading = curve.evaluate(unit_pair, 1.0, x_m * (1 - 1e-12), x_m);
  EXPECT_NEAR(loading.force, unloading.force, 1e-10 * loading.force);
  EXPECT_NEAR(loading.contact_radius, unloading.contact_radius, 1e-10 * loading.contact_radius);
}

TEST(ContactCurve, ElasticBodyReturnsEverything)
{
  const Law law = SyntheticLaw{}.law();
  const ContactCurve& glass = law.bodies.at("glass").curve;
  EXPECT_DOUBLE_EQ(glass.work_loading(0.01), glass.work_unloading(0.01));
  EXPECT_DOUBLE_EQ(glass.evaluate(unit_pair, 1.0, 0.005, 0.01).force, glass.loading(0.005).force);
}

TEST(ContactCurve, RefusesUnusableTables)
{
  const auto broken = [](auto change) {
    ContactCurve::Table table = SyntheticLaw{}.table();
    change(table);
    return table;
  };
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.force_ratio[3] = NAN; }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.exponent_slope[3] = INFINITY; }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.exponent.pop_back(); }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.residual_ratio[5] = 1.0; }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.exponent[5] = 0.9; }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.hertz_share.pop_back(); }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.hertz_share[5] = -0.01; }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.hertz_share[5] = 4.5; }), "x"), Error);  // A + 4 n > 10
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.s_end = 0; }), "x"), Error);
  EXPECT_THROW(ContactCurve(broken([](auto& t) { t.onset = NAN; }), "x"), Error);
}

}  // namespace
}  // namespace granulaw
