#include "characterise/tabulate_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"

namespace granulaw {
namespace {

constexpr double onset = 1e-4;

/// Hertz's force, then straight on; losses as given functions of ln(x/onset).
CurveSource source(std::function<double(double)> residual, std::function<double(double)> dissipation)
{
  CurveSource s;
  s.onset = onset;
  s.loading = [](double x) {
    const double top = std::pow(onset, 1.5), slope = 1.5 * std::sqrt(onset);
    return x <= onset ? ContactCurve::Loading{x * std::sqrt(x), 1.5 * std::sqrt(x), std::sqrt(x)}
                      : ContactCurve::Loading{top + slope * (x - onset), slope, std::sqrt(x)};
  };
  s.residual = [=](double x) { return residual(std::log(x / onset)); };
  s.dissipation = [=](double x) { return dissipation(std::log(x / onset)); };
  s.hertz_share = [](double) { return 0.5; };
  return s;
}

TEST(TabulateCurve, HasTheSourcesFunctions)
{
  const CurveSource s = source([](double q) { return 0.05 * q * q; }, [](double q) { return 0.06 * q * q; });
  const ContactCurve curve = tabulate(s, 0.01);
  for (double x = 1e-5; x < 0.01; x *= 1.07) {
    // 2e-5: cubics in s
    EXPECT_NEAR(curve.loading(x).force / s.loading(x).force, 1, 2e-5) << x;
    if (x < onset) {
      EXPECT_NEAR(curve.work_unloading(x) / curve.work_loading(x), 1, 1e-12);
      continue;
    }
    EXPECT_NEAR(-std::log1p(-curve.reversal(x).residual / x), s.residual(x), 2e-4) << x;
    // 2e-4: the least loss
    EXPECT_NEAR(-std::log(curve.work_unloading(x) / curve.work_loading(x)), s.dissipation(x), 4e-4) << x;
  }
}

/// Losses that fall, jump or scatter: the law's dissipated work does not fall.
TEST(TabulateCurve, IsAdmissibleWhateverTheLosses)
{
  using Losses = std::function<double(double)>;
  const Losses scattering = [](double q) { return 0.1 * q * q * (1 + 0.3 * std::sin(20 * q)); },
               jumping = [](double q) { return q < 1 ? 0.0 : 0.5; }, nothing = [](double) { return 0.0; },
               falling = [](double q) { return 0.3 * q * std::exp(-q); };
  for (const Losses& dissipation : {scattering, jumping, nothing, falling}) {
    const ContactCurve curve = tabulate(source(nothing, dissipation), 0.01);
    double before = 0;
    for (double x = onset * (1 + 1e-9); x < 0.01; x *= 1.003) {
      const double dissipated = curve.work_loading(x) - curve.work_unloading(x);
      EXPECT_GE(dissipated, before - 1e-12 * curve.work_loading(x)) << x;  // rounding
      before = dissipated;
    }
  }
}

/// Nothing lost over 0.4 R leaves no residual overlap that costs nothing: an unloading which is that steep
/// has less work, and what it returns goes first.
TEST(TabulateCurve, TakesFromTheResidualWhatAnUnloadingCannotReturn)
{
  const ContactCurve curve =
      tabulate(source([](double) { return 0.0; }, [](double q) { return 0.5 * q; }), 0.01);
  const double x = 0.009;
  EXPECT_NEAR(-std::log(curve.work_unloading(x) / curve.work_loading(x)), 0.5 * std::log(x / onset), 1e-3);
  EXPECT_GE(curve.reversal(x).residual, 0);
}

TEST(TabulateCurve, RefusesALoadingForceThatFalls)
{
  CurveSource s = source([](double q) { return 0.1 * q; }, [](double q) { return 0.1 * q; });
  s.loading = [](double x) {
    return ContactCurve::Loading{std::sin(400 * x) + 1.5, 400 * std::cos(400 * x), std::sqrt(x)};
  };
  EXPECT_THROW(tabulate(s, 0.01), Error);
}

}  // namespace
}  // namespace granulaw
