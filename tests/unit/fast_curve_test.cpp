#include "law/fast_curve.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "law_paths.hpp"
#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::SyntheticLaw;
using testing::unit_pair;

/// Largest differences from the curve: of the force over that at the reversal point, of stiffness and radius
/// over theirs at the reversal point.
struct Worst
{
  double force = 0, stiffness = 0, radius = 0;
};

Worst compare(const ContactCurve& curve, double lowest, bool with_axis)
{
  const FastCurve fast(curve);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> log_x(std::log(lowest), std::log(1.1 * curve.x_end())),
      part(0.0, 1.3);
  Worst worst;
  for (int k = 0; k < 200000; ++k) {
    const double x_max = std::exp(log_x(random)), x = x_max * part(random);
    const double X = with_axis ? curve.axis()->overlap_end() * part(random) : 0.0;
    const ContactForce expected = curve.evaluate(unit_pair, 1.0, x, x_max, X);
    const ContactForce found = fast.evaluate(unit_pair, 1.0, x, x_max, X);
    const ContactCurve::Loading top = curve.loading(std::max(x, x_max), X);
    const double alone = fast.force(x, x_max, X);
    EXPECT_GE(found.force, 0.0);
    EXPECT_EQ(found.delta_max, expected.delta_max);
    // two ways to the same force: rounding, which u^n near u = 0 does not amplify
    EXPECT_NEAR(alone, found.force, 1e-10 * top.force);
    worst.force = std::max(worst.force, std::abs(found.force - expected.force) / top.force);
    const double stiffness = curve.evaluate(unit_pair, 1.0, x_max * (1 - 1e-12), x_max, X).stiffness;
    worst.stiffness = std::max(
        worst.stiffness, std::abs(found.stiffness - expected.stiffness) / std::max(stiffness, top.stiffness));
    worst.radius =
        std::max(worst.radius, std::abs(found.contact_radius - expected.contact_radius) / top.radius);
  }
  return worst;
}

/// A law that answers what is no number with a force would hide the error that made it.
TEST(FastCurve, NoNumberInNoForceOut)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const bool with_axis : {false, true}) {
    const ContactCurve curve = with_axis ? SyntheticLaw().curve_with_axis() : SyntheticLaw().curve();
    const FastCurve fast(curve);
    const double x = 0.5 * curve.x_end(), X = with_axis ? curve.axis()->overlap_end() : 0.0;
    for (const auto& [now, largest] : {std::pair(none, x), std::pair(none, 0.0), std::pair(x, none)}) {
      EXPECT_TRUE(std::isnan(fast.force(now, largest, X)));
      EXPECT_TRUE(std::isnan(fast.evaluate(now, largest, X).force));
      EXPECT_TRUE(std::isnan(curve.evaluate(unit_pair, 1.0, now, largest, X).force));
    }
    EXPECT_TRUE(std::isnan(fast.loading_response(none, X).force));
    EXPECT_TRUE(std::isnan(fast.reversal(none, X).response_at(x).force));
  }
}

TEST(FastCurve, AgreesWithTheCurve)
{
  for (const bool with_axis : {false, true})
    for (const double onset : {6.4e-4, 6.4e-6}) {
      SyntheticLaw law;
      law.onset = onset;
      const Worst worst = compare(with_axis ? law.curve_with_axis() : law.curve(), 1e-13, with_axis);
      // An eighth of an octave and cubics: (1/8)^4/400 of a fourth derivative of order one is 1e-6; the steep
      // start of the residual at the onset (the synthetic law has a jump in curvature there) costs a decade.
      // A derivative loses another. The law itself is asked for 1e-3.
      EXPECT_LT(worst.force, 2e-5) << onset;
      EXPECT_LT(worst.radius, 1e-4) << onset;
      EXPECT_LT(worst.stiffness, 1e-3) << onset;
      printf("onset %g%s: force %.2g, stiffness %.2g, radius %.2g\n", onset, with_axis ? ", axis" : "",
             worst.force, worst.stiffness, worst.radius);
    }
}

TEST(FastCurve, AnElasticCurveStaysElastic)
{
  const Law law = SyntheticLaw{}.law();
  const ContactCurve& curve = law.bodies.at("glass").curve;
  EXPECT_LT(compare(curve, 1e-9, false).force, 1e-6);  // smooth: no onset
  EXPECT_EQ(FastCurve(curve).dissipated(0.01), 0.0);
}

RC_GTEST_PROP(FastCurve, StiffnessIsTheDerivativeOfTheForce, ())
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  testing::stiffness_is_the_derivative(FastCurve(curve), curve,
                                       curve.axis()->overlap_end() * *rc::gen::inRange(0, 1000) / 1000.0);
}

TEST(FastCurve, IsContinuousAcrossItsNodes)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  const FastCurve fast(curve);
  for (int e = -39; e < -4; ++e)
    for (int part = 0; part < 8; ++part) {
      const double x = std::ldexp(1 + part / 8.0, e), below = std::nextafter(x, 0.0);
      if (x > curve.x_end()) continue;
      for (const double X : {0.0, 0.03}) {
        const ContactForce a = fast.evaluate(unit_pair, 1.0, below, 0.0, X),
                           b = fast.evaluate(unit_pair, 1.0, x, 0.0, X);
        // rounding; the stiffness subtracts numbers 10 times larger
        EXPECT_NEAR(a.force, b.force, 1e-14 * b.force);
        EXPECT_NEAR(a.stiffness, b.stiffness, 1e-12 * b.stiffness);
        EXPECT_NEAR(a.contact_radius, b.contact_radius, 1e-14 * b.contact_radius);
      }
    }
}

TEST(FastCurve, AReversalThatIsKeptAnswersToTheBit)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  const FastCurve fast(curve);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> log_x(std::log(curve.onset()), std::log(1.1 * curve.x_end())),
      part(0.0, 1.0);
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (int k = 0; k < 20000; ++k) {
    const double x_max = std::exp(log_x(random)),
                 X = k % 3 ? curve.axis()->overlap_end() * part(random) : 0.0;
    const FastCurve::Reversal reversal = fast.reversal(x_max, X);
    for (const double x : {x_max * part(random), std::nextafter(x_max, 0.0)}) {
      ASSERT_TRUE(fast.unloads(x, x_max));
      EXPECT_TRUE(same(reversal.force_at(x), fast.force(x, x_max, X)));
      const ContactCurve::Loading kept = fast.evaluate(x, reversal), anew = fast.evaluate(x, x_max, X);
      EXPECT_TRUE(same(kept.force, anew.force) && same(kept.stiffness, anew.stiffness) &&
                  same(kept.radius, anew.radius));
    }
    // rounding only: what is divided by the range is 3e5 times smaller at its least (largest_ratio)
    EXPECT_NEAR(reversal.force_at(x_max), fast.loading_force(x_max, X), 1e-13 * fast.loading_force(x_max, X));
    // the fast table's error of force and span: 2e-5 (AgreesWithTheCurve)
    EXPECT_NEAR(reversal.work(), curve.work_unloading(x_max, X), 1e-4 * curve.work_unloading(x_max, X));
  }
  EXPECT_FALSE(fast.unloads(0.9 * curve.onset(), curve.onset()));
}

TEST(FastCurve, WithoutAnImpactTheForceIsThatOfACurveWithoutAnAxisToTheBit)
{
  const ContactCurve plain = SyntheticLaw{}.curve(), with = SyntheticLaw{}.curve_with_axis();
  const FastCurve a(plain), b(with);
  for (int k = 1; k < 1000; ++k)
    for (const double part : {0.7, 0.97, 1.1}) {
      const double x_max = 0.11 * std::pow(k / 1000.0, 5);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.force(part * x_max, x_max)),
                std::bit_cast<std::uint64_t>(b.force(part * x_max, x_max, 0.0)));
    }
}

TEST(FastCurve, DissipatedWork)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  const FastCurve fast(curve);
  for (const double x : {1e-3, 3.3e-3, 1e-2, 0.05, 0.099, 0.12}) {
    const double expected = curve.work_loading(x) - curve.work_unloading(x);
    EXPECT_NEAR(fast.dissipated(x), expected, 1e-4 * curve.work_loading(x)) << x;  // as the force
    EXPECT_EQ(fast.dissipated(0, x, 0.0), fast.dissipated(x));
  }
  EXPECT_EQ(fast.dissipated(0.5 * curve.onset()), 0.0);
  // in the steps of a particle code, and in three large ones
  for (const double X : {0.01, 0.04, 0.1})
    for (const int steps : {3, 20, 200}) {
      double sum = 0;
      for (int k = 0; k < steps; ++k) sum += fast.dissipated(0.08 * k / steps, 0.08 * (k + 1) / steps, X);
      const double put_in = curve.work_loading(0.08, X);
      // 1e-4: Simpson's rule over steps of a quarter; 2e-5 of it the fast curve itself
      EXPECT_NEAR(sum, put_in - curve.work_unloading(0.08, X), 1e-4 * put_in) << X << ", " << steps;
    }
}

TEST(FastCurve, ATableThatEndsBelowTheFirstOctaveIsLeftToTheCurve)
{
  SyntheticLaw law;
  law.x_end = 1e-20;
  const ContactCurve curve = law.curve();
  const FastCurve fast(curve);
  EXPECT_EQ(fast.force(1e-21, 0.0), curve.loading(1e-21).force);
  EXPECT_EQ(fast.force(1e-19, 0.0), curve.loading(1e-19).force);
}

TEST(FastCurve, IsSmall)
{
  const ContactCurve curve = SyntheticLaw{}.curve_with_axis();
  EXPECT_LT(FastCurve(curve).bytes(), 256u << 10);  // of a processor's second cache
}

}  // namespace
}  // namespace granulaw
