#include "law/velocity_axis.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "base/error.hpp"
#include "law/replay.hpp"
#include "law_paths.hpp"
#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::SyntheticLaw;
using testing::unit_pair;

bool same_bits(double a, double b)
{
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(VelocityAxis, ReproducesCubicsInTheRatioAndLinesInTheImpactOverlap)
{
  const auto a = [](double xi) { return (1 - xi) * (1 - xi) * (0.4 + 0.3 * xi); };
  const auto da = [](double xi) { return (1 - xi) * (-0.8 - 0.6 * xi + 0.3 * (1 - xi)); };
  const auto b = [](double xi) { return 0.01 * xi * xi * xi; };
  const auto n = [](double xi) { return 0.1 * xi * xi; };
  VelocityAxis::Table t = SyntheticLaw{}.axis(3, 5);
  t.ratio_end = 1;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 5; ++l) {
      const double xi = static_cast<double>(l) / 4, part = static_cast<double>(k + 1);
      t.force_correction[5 * k + l] = part * a(xi);
      t.force_correction_slope[5 * k + l] = part * da(xi);
      t.residual_correction[5 * k + l] = part * b(xi);
      t.residual_correction_slope[5 * k + l] = part * 0.03 * xi * xi;
      t.exponent_correction[5 * k + l] = part * n(xi);
      t.exponent_correction_slope[5 * k + l] = part * 0.2 * xi;
    }
  const VelocityAxis axis(t, "test");
  for (const double X : {1e-6, 0.01, 0.04, 0.0999, 0.1})
    for (const double xi : {0.0, 1e-9, 0.1, 0.25, 0.3, 0.77, 0.999}) {
      const double part = 3 * X / axis.overlap_end();
      // 1e-14: rounding of a dozen operations on numbers of order one
      EXPECT_NEAR(axis.force(xi * X, X).value, part * a(xi), 1e-14);
      EXPECT_NEAR(axis.force(xi * X, X).slope * X, part * da(xi), 1e-13);
      EXPECT_NEAR(axis.reversal(xi * X, X).force, part * a(xi), 1e-14);
      EXPECT_NEAR(axis.reversal(xi * X, X).residual, part * b(xi), 1e-14);
      EXPECT_NEAR(axis.reversal(xi * X, X).exponent, part * n(xi), 1e-14);
    }
  // beyond the last node; and an X beyond X_end counts as X_end
  EXPECT_EQ(axis.force(0.11, 0.1).value, 0.0);
  EXPECT_EQ(axis.force(0.11, 0.1).slope, 0.0);
  EXPECT_NEAR(axis.reversal(0.3, 0.1).residual, 0.03, 1e-14);
  EXPECT_NEAR(axis.reversal(0.3, 0.1).exponent, 0.3, 1e-14);
  EXPECT_NEAR(axis.force(0.1, 0.2).value, 3 * a(0.5), 1e-14);
}

TEST(VelocityAxis, ImpactOverlapRisesFromZeroAndIsClamped)
{
  const VelocityAxis axis(SyntheticLaw{}.axis(), "test");
  EXPECT_EQ(axis.impact_overlap(0), 0.0);
  EXPECT_EQ(axis.impact_overlap(-1), 0.0);
  EXPECT_EQ(axis.impact_overlap(NAN), 0.0);
  double before = 0;
  for (int k = 1; k <= 300; ++k) {
    const double r = k / 300.0, X = axis.impact_overlap(axis.speed_end() * r);
    EXPECT_NEAR(X, 0.1 * r * (0.6 + 0.4 * r), 1e-15);  // the synthetic X(v) is a quadratic: exact
    EXPECT_GT(X, before);
    before = X;
  }
  EXPECT_EQ(axis.impact_overlap(axis.speed_end()), axis.overlap_end());
  EXPECT_EQ(axis.impact_overlap(HUGE_VAL), axis.overlap_end());
}

TEST(VelocityAxis, TheFirstLevelsDivideTheFirstSpacing)
{
  // 5 levels, 3 of them within the first of 3 spacings: 0.01, 0.02, 0.03; 0.06, 0.09
  const ImpactLevels scale = ImpactLevels::from_standstill(5, 3, 0.09);
  const double places[] = {0, 0.01, 0.02, 0.03, 0.06, 0.09};
  for (int k = 0; k <= 5; ++k) {
    EXPECT_NEAR(scale.overlap(k), places[k], 1e-15);
    EXPECT_NEAR(scale.row(places[k]), k, 1e-13);
  }
  EXPECT_NEAR(scale.row(0.015), 1.5, 1e-13);
  EXPECT_NEAR(scale.row(0.045), 3.5, 1e-13);
  EXPECT_EQ(scale.row(1.0), 5.0);
  const ImpactLevels even = ImpactLevels::from_standstill(4, 1, 0.08);
  for (int k = 0; k <= 4; ++k) EXPECT_NEAR(even.row(0.02 * k), k, 1e-13);
}

TEST(VelocityAxis, ARateAxisBeginsAtItsSlowestImpactAndIsLinearInOctaves)
{
  VelocityAxis::Table t = SyntheticLaw{}.rate_axis(1e-3);
  const std::size_t nodes = t.ratio_nodes();
  // each level its number: the correction tells the row
  for (std::size_t k = 0; k < t.levels; ++k)
    for (std::size_t l = 0; l < nodes; ++l) {
      t.exponent_correction[k * nodes + l] = static_cast<double>(k + 1);
      t.exponent_correction_slope[k * nodes + l] = 0;
    }
  const VelocityAxis axis(t, "test");
  const double first = axis.impact_overlap(t.speed_begin), end = axis.overlap_end();
  EXPECT_NEAR(first, 0.1 * (1 / 40.0) * (0.6 + 0.4 / 40), 1e-15);
  const auto row = [&](double X) { return axis.reversal(0.5 * X, X).exponent; };
  EXPECT_EQ(axis.impact_overlap(1e-3 * t.speed_begin), first);  // held
  EXPECT_EQ(axis.impact_overlap(0), 0.0);
  EXPECT_NEAR(row(first), 1.0, 1e-12);
  EXPECT_NEAR(row(0.1 * first), 1.0, 1e-12);
  EXPECT_NEAR(row(end), 8.0, 1e-12);
  // e + m of X = (1 + m) 2^e, from frexp: another way to the same
  const auto q = [](double X) {
    int e = 0;
    const double f = std::frexp(X, &e);
    return e - 1 + 2 * f - 1;
  };
  for (const double X : {0.0016, 0.002, 1 / 512.0, 0.0077, 0.03, 0.09}) {
    const double expected = 1 + 7 * (q(X) - q(first)) / (q(end) - q(first));
    EXPECT_NEAR(row(X), expected, 1e-11) << X;  // the bits of 1023 + e leave 2e-13 of an octave
    EXPECT_NEAR(axis.scale().overlap(row(X)), X, 1e-11 * X);
  }
  const std::vector<double> examined = axis.examined_overlaps();
  ASSERT_EQ(examined.size(), 15u);
  EXPECT_EQ(examined.front(), first);
  EXPECT_EQ(examined.back(), end);
}

TEST(VelocityAxis, ARateLawIsOfOneSize)
{
  Law law = SyntheticLaw{}.law_with_axis();
  law.bodies["powder"].curve = ContactCurve(SyntheticLaw{}.table(), SyntheticLaw{}.rate_axis(2e-3), "test");
  const PairLaw wall = resolve_pair(law, "powder", "wall", "test");
  EXPECT_EQ(wall.only_radius(), 2e-3);
  EXPECT_NO_THROW(check_size(wall, 2e-3, "test"));
  EXPECT_NO_THROW(check_size(wall, 1.04 * 2e-3, "test"));
  EXPECT_THROW(check_size(wall, 1.06 * 2e-3, "test"), Error);
  EXPECT_THROW(check_size(wall, NAN, "test"), Error);
  EXPECT_NO_THROW(check_size(resolve_pair(law, "glass", "wall", "test"), 1.0, "test"));
  const double mass = wall.usual_mass(2e-3), unit = std::sqrt(1e8 / 1500.0);
  EXPECT_NEAR(wall.min_speed(2e-3, mass), 0.066 / 40 * unit, 1e-9);
  const double slow = 0.5 * wall.min_speed(2e-3, mass);
  EXPECT_TRUE(replay_collision(wall, 2e-3, mass, slow).held_speed);
  EXPECT_FALSE(replay_collision(wall, 2e-3, mass, 3 * slow).held_speed);
}

TEST(VelocityAxis, WithoutAnImpactTheLawIsTheCurveWithoutAnAxisToTheBit)
{
  const ContactCurve plain = SyntheticLaw{}.curve(), with = SyntheticLaw{}.curve_with_axis();
  for (int k = 1; k < 400; ++k)
    for (const double part : {0.3, 0.95, 1.0, 1.2}) {
      const double x_m = 0.12 * std::pow(k / 400.0, 4), x = part * x_m;
      const ContactForce a = plain.evaluate(unit_pair, 1.0, x, x_m),
                         b = with.evaluate(unit_pair, 1.0, x, x_m, 0);
      EXPECT_TRUE(same_bits(a.force, b.force) && same_bits(a.stiffness, b.stiffness) &&
                  same_bits(a.contact_radius, b.contact_radius) && same_bits(a.delta_max, b.delta_max));
      // an axis-less curve ignores X
      EXPECT_TRUE(same_bits(a.force, plain.evaluate(unit_pair, 1.0, x, x_m, 0.05).force));
    }
  EXPECT_EQ(plain.axis(), nullptr);
  ASSERT_NE(with.axis(), nullptr);
}

TEST(VelocityAxis, VanishesForSmallImpactsAndWellBeyondThem)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  for (const double x : {1e-6, 1e-3, 0.02, 0.09}) {
    const double slow = curve.loading(x).force;
    // the corrections are proportional to X: at most half of X/X_end
    EXPECT_NEAR(curve.loading(x, 1e-9).force, slow, 0.5e-8 * slow);
    EXPECT_EQ(curve.loading(x, x / 1.51).force, slow);
  }
}

RC_GTEST_PROP(VelocityAxis, StiffnessIsTheDerivativeOfTheForce, ())
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  testing::stiffness_is_the_derivative(curve, curve,
                                       curve.axis()->overlap_end() * *rc::gen::inRange(1, 1000) / 1000.0);
}

TEST(VelocityAxis, WorkFunctionsAreTheIntegralsOfTheForce)
{
  using boost::math::quadrature::gauss_kronrod;
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  for (const double overlap : {0.003, 0.0713, 0.1})
    for (const double x : {1e-5, 6.4e-4, 3e-3, 0.02, 0.0999, 0.12}) {
      const auto in_s = [&](double s) { return 4 * s * s * s * curve.loading(s * s * s * s, overlap).force; };
      const double loading = gauss_kronrod<double, 61>::integrate(in_s, 0.0, std::pow(x, 0.25), 15, 1e-12);
      EXPECT_NEAR(curve.work_loading(x, overlap) / loading, 1.0, 1e-9) << x;
      const auto back = [&](double y) { return curve.evaluate(unit_pair, 1.0, y, x, overlap).force; };
      const double residual = x > curve.onset() ? curve.reversal(x, overlap).residual : 0.0;
      const double unloading = gauss_kronrod<double, 61>::integrate(back, residual, x, 15, 1e-12);
      EXPECT_NEAR(curve.work_unloading(x, overlap) / unloading, 1.0, 1e-9) << x;
    }
}

TEST(VelocityAxis, WorkOfManyOverlapsIsThatOfEach)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  const double end = curve.x_end(), latched = 0.4 * curve.axis()->overlap_end();
  // below the onset, on a node, twice the same, beyond ratio_end, beyond the table
  const std::vector<double> overlaps{0.0,     1e-6,           1e-3,      1e-3, 0.3 * end, 0.31 * end,
                                     latched, 1.01 * latched, 0.9 * end, end,  1.5 * end};
  for (const double impact_overlap : {0.0, latched, curve.axis()->overlap_end()}) {
    const std::vector<double> works = curve.work_loading(overlaps, impact_overlap);
    ASSERT_EQ(works.size(), overlaps.size());
    for (std::size_t k = 0; k < overlaps.size(); ++k) {
      const double alone = curve.work_loading(overlaps[k], impact_overlap);
      // the integrals are exact to 1e-12, piece by piece
      EXPECT_NEAR(works[k], alone, 1e-11 * alone) << overlaps[k] << " " << impact_overlap;
    }
  }
}

TEST(VelocityAxis, AdmissibilityIsThatOfEveryImpactOverlap)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  double least = curve.admissibility_margin(0.0);
  for (int k = 1; k <= 16; ++k)
    least = std::min(least, curve.admissibility_margin(curve.axis()->overlap_end() * k / 16));
  EXPECT_EQ(curve.admissibility_margin(), least);
  EXPECT_GE(least, 0);
  // an axis that raises the unloading work of deep reversals, of its largest X only, is found out
  SyntheticLaw law;
  VelocityAxis::Table bad = law.axis();
  const std::size_t nodes = bad.ratio_nodes();
  for (std::size_t l = 0; l < nodes; ++l) {
    double& b = bad.residual_correction[(bad.levels - 1) * nodes + l];
    bad.residual_correction_slope[(bad.levels - 1) * nodes + l] = 0;
    b = l > nodes / 2 ? -0.5 : 0.0;
  }
  const ContactCurve cheat(law.table(), bad, "test");
  EXPECT_GE(cheat.admissibility_margin(0.0), 0);
  EXPECT_LT(cheat.admissibility_margin(), 0);
}

RC_GTEST_PROP(VelocityAxis, NoClosedCycleGainsEnergy, ())
{
  SyntheticLaw law;
  law.force_reduction = *rc::gen::inRange(50, 250) / 100.0;
  law.depth = *rc::gen::inRange(20, 200) / 100.0;
  law.onset = std::pow(10.0, -*rc::gen::inRange(200, 600) / 100.0);
  const ContactCurve curve = law.curve_with_axis();
  RC_PRE(curve.admissibility_margin() >= 0);
  testing::no_closed_cycle_gains(curve, curve,
                                 curve.axis()->overlap_end() * *rc::gen::inRange(0, 1001) / 1000.0);
}

TEST(VelocityAxis, SpeedsOfPairs)
{
  const Law law = SyntheticLaw{}.law_with_axis();
  const PairLaw wall = resolve_pair(law, "powder", "wall", "test"),
                like = resolve_pair(law, "powder", "powder", "test");
  const double R = 2e-3, unit = std::sqrt(1e8 / 1500.0);  // sqrt(Y/rho), m/s
  for (const double v : {0.003, 0.03, 0.06}) {
    const double X = wall.curve->axis()->impact_overlap(v);
    EXPECT_NEAR(wall.impact_overlap(R, wall.usual_mass(R), v * unit), X, 1e-12 * X);
    EXPECT_NEAR(wall.impact_overlap(10 * R, wall.usual_mass(10 * R), v * unit), X,
                1e-12 * X);  // size does not matter
    EXPECT_NEAR(like.impact_overlap(R / 2, like.usual_mass(R / 2), 2 * v * unit), X, 1e-12 * X);
  }
  // Against a partner that hardly moves the same body is twice as heavy in m*: the one body's I doubles.
  EXPECT_NEAR(like.impact_overlap(R / 2, 2 * like.usual_mass(R / 2), 0.06 / std::sqrt(2.0) * unit),
              wall.curve->axis()->impact_overlap(0.03), 1e-9);
  EXPECT_NEAR(wall.max_speed(R, wall.usual_mass(R)), 0.066 * unit, 1e-9);
  EXPECT_NEAR(like.max_speed(R, like.usual_mass(R)), 2 * 0.066 * unit, 1e-9);
  const PairLaw glass = resolve_pair(law, "glass", "wall", "test");
  EXPECT_EQ(glass.impact_overlap(R, glass.usual_mass(R), 100), 0.0);
  EXPECT_EQ(glass.max_speed(R, glass.usual_mass(R)), HUGE_VAL);

  Law rate = law;
  rate.bodies["powder"].curve = ContactCurve(SyntheticLaw{}.table(), SyntheticLaw{}.rate_axis(R), "test");
  const PairLaw rate_wall = resolve_pair(rate, "powder", "wall", "test");
  const PairLaw rate_like = resolve_pair(rate, "powder", "powder", "test");
  const double v = 0.03, X = wall.curve->axis()->impact_overlap(v);
  EXPECT_NEAR(rate_wall.impact_overlap(R, rate_wall.usual_mass(R), v * unit), X, 1e-12 * X);
  EXPECT_NEAR(rate_wall.impact_overlap(2 * R, rate_wall.usual_mass(2 * R), 2 * v * unit), X,
              1e-12 * X);  // the same strain rate
  EXPECT_NEAR(rate_like.impact_overlap(R / 2, rate_like.usual_mass(R / 2), 2 * v * unit), X,
              1e-12 * X);  // two walls at half the speed
}

TEST(VelocityAxis, AReplayLatchesItsOwnSpeed)
{
  const Law law = SyntheticLaw{}.law_with_axis();
  const PairLaw wall = resolve_pair(law, "powder", "wall", "test");
  const double R = 1e-3, mass = 4.0 / 3.0 * M_PI * 1500 * R * R * R;
  const double speed = 0.5 * wall.max_speed(R, wall.usual_mass(R)),
               X = wall.impact_overlap(R, wall.usual_mass(R), speed);
  const Replay replay = replay_collision(wall, R, mass, speed);
  // e^2 is the ratio of the work functions of that X; 1e-4: the replay's step
  const double x_m = replay.delta_max / R;
  const double e = std::sqrt(wall.curve->work_unloading(x_m, X) / wall.curve->work_loading(x_m, X));
  EXPECT_NEAR(replay.restitution, e, 1e-4);
  const double slow = std::sqrt(wall.curve->work_unloading(x_m) / wall.curve->work_loading(x_m));
  EXPECT_GT(std::abs(slow - e), 1e-3);  // else the above says nothing
  EXPECT_FALSE(replay.left_speeds);
  EXPECT_TRUE(replay_collision(wall, R, mass, 2.5 * speed).left_speeds);
}

TEST(VelocityAxis, RefusesUnusableTables)
{
  using Table = VelocityAxis::Table;
  const auto refused = [](auto change) -> std::string {
    Table axis = SyntheticLaw{}.axis();
    change(axis);
    try {
      ContactCurve(SyntheticLaw{}.table(), axis, "x");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused([](Table&) {}), "");
  const auto says = [&](auto change, const char* what) {
    const std::string sentence = refused(change);
    EXPECT_NE(sentence.find(what), std::string::npos) << "wanted '" << what << "', got: " << sentence;
  };
  says([](Table& t) { t.levels = 0; }, "slices");
  says([](Table& t) { t.levels = 1000; }, "slices");
  says([](Table& t) { t.levels = 7; }, "length");
  says([](Table& t) { t.first_levels = 9; }, "first_slices");
  says([](Table& t) { t.first_levels = 0; }, "first_slices");
  says([](Table& t) { t.speed_end = NAN; }, "speed_end");
  says([](Table& t) { t.ratio_end = 0; }, "ratio_end");
  says([](Table& t) { t.reference_radius = 1e-3; }, "reference_radius");
  says([](Table& t) { t.kind = VelocityAxis::Kind::rate; }, "reference_radius");
  says([](Table& t) { t.speed_begin = 1e-3; }, "speed_begin");
  says([](Table& t) { t = SyntheticLaw{}.rate_axis(1e-3), t.speed_begin = 0; }, "speed_begin");
  says([](Table& t) { t = SyntheticLaw{}.rate_axis(1e-3), t.speed_begin = t.speed_end; }, "speed_begin");
  says([](Table& t) { t = SyntheticLaw{}.rate_axis(1e-3, 1); }, "slices");
  says(
      [](Table& t) {  // X that does not rise before speed_begin
        t = SyntheticLaw{}.rate_axis(1e-3);
        t.impact_overlap[1] = t.impact_overlap_slope[0] = t.impact_overlap_slope[1] = 0;
      },
      "speed_begin");
  says([](Table& t) { t.impact_overlap.resize(1); }, "impact_overlap");
  says([](Table& t) { t.impact_overlap_slope.pop_back(); }, "length");
  says([](Table& t) { t.impact_overlap[0] = 1e-3; }, "begin at 0");
  says([](Table& t) { t.impact_overlap[5] = NAN; }, "impact_overlap");
  says([](Table& t) { std::swap(t.impact_overlap[5], t.impact_overlap[6]); }, "falls");
  says([](Table& t) { t.impact_overlap_slope[5] *= 20; }, "falls");
  says(
      [](Table& t) {
        for (double& X : t.impact_overlap) X *= 1.1;
      },
      "deeper");
  says([](Table& t) { t.force_correction[3] = -0.95; }, "force_correction");
  says([](Table& t) { t.force_correction_slope[3] = HUGE_VAL; }, "force_correction_slope");
  says([](Table& t) { t.force_correction_slope[3] = -1e4; }, "between nodes");
  says([](Table& t) { t.force_correction.back() = 1e-6; }, "end at 0");
  says([](Table& t) { t.force_correction_slope[24] = 1e-6; }, "end at 0");
  says([](Table& t) { t.residual_correction.pop_back(); }, "length");
  says([](Table& t) { t.exponent_correction[9] = NAN; }, "exponent_correction");
  says([](Table& t) { t.force_correction_slope[8] = -9; }, "loading force falls");
  says([](Table& t) { t.residual_correction[7 * 25 + 15] = 0.3; }, "residual ratio");
  says([](Table& t) { t.exponent_correction[7 * 25 + 15] = -0.9; }, "exponent is out of range");
}

/// What is accepted evaluates to finite, never negative forces, however wild.
RC_GTEST_PROP(VelocityAxis, WhatIsAcceptedIsUsable, ())
{
  SyntheticLaw law;
  VelocityAxis::Table axis = law.axis(3, 6);
  const auto shake = [&](std::vector<double>& values, double size) {
    const int hits = *rc::gen::inRange(0, 4);
    for (int k = 0; k < hits; ++k)
      values[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(values.size())))] +=
          size * *rc::gen::inRange(-1000, 1001) / 1000.0;
  };
  shake(axis.force_correction, 0.3);
  shake(axis.force_correction_slope, 1);
  shake(axis.residual_correction, 0.2);
  shake(axis.residual_correction_slope, 2);
  shake(axis.exponent_correction, 1);
  shake(axis.exponent_correction_slope, 10);
  ContactCurve curve;
  try {
    curve = ContactCurve(law.table(), axis, "test");
  } catch (const Error&) {
    RC_DISCARD("refused");
  }
  for (int k = 0; k < 200; ++k) {
    const double overlap = curve.axis()->overlap_end() * *rc::gen::inRange(0, 1200) / 1000.0;
    const double x_m = 3 * curve.x_end() * std::pow(*rc::gen::inRange(1, 1001) / 1000.0, 6);
    const ContactForce f =
        curve.evaluate(unit_pair, 1.0, x_m * *rc::gen::inRange(1, 1100) / 1000.0, x_m, overlap);
    RC_ASSERT(f.force >= 0 && std::isfinite(f.force) && std::isfinite(f.stiffness));
    RC_ASSERT(f.contact_radius >= 0 && std::isfinite(f.contact_radius));
  }
}

}  // namespace
}  // namespace granulaw
