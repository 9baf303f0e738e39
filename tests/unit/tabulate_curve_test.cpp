#include "atlas/tabulate_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "law/spline.hpp"

namespace granulaw::tabulate_curve_test {

constexpr double onset = 1e-4, end = 0.1;

/// Losses as functions of u, 0 at the onset and 1 at the end.
LawShape shape_with(const std::function<double(double)>& residual,
                    const std::function<double(double)>& dissipation)
{
  LawShape shape = LawShape::zero(onset, end);
  shape.elastic.c1 = 0.9, shape.elastic.d1 = 0.1;
  for (std::size_t k = 1; k < LawShape::nodes; ++k) {
    const double u = static_cast<double>(k) / (LawShape::nodes - 1);
    shape.force_reduction[k] = 1.5 * u * u;
    shape.widening[k] = 0.3 * u * u;
    shape.residual[k] = residual(u), shape.dissipation[k] = dissipation(u);
  }
  return shape;
}

TEST(TabulateCurve, HasTheShapesFunctions)
{
  const LawShape shape = shape_with([](double u) { return 2 * u * u; }, [](double u) { return 2.2 * u * u; });
  const Curve curve = tabulate(shape, end);
  const Spline residual = shape.by_q(&LawShape::residual), dissipation = shape.by_q(&LawShape::dissipation);
  // 3.2e-6: a cubic over the last interval, whose far node lies beyond the end, where the functions go straight
  EXPECT_LT(table_error(shape, curve), 4e-6);
  EXPECT_LT(change_of_restitution(shape, curve),
            1e-5);  // the same, and the spline's first interval
  for (double x = 1.4 * onset; x < end; x *= 1.07) {
    EXPECT_NEAR(std::sqrt(curve.kept(x)), std::exp(-0.5 * dissipation.value(shape.q(x))), 1e-6) << x;
    EXPECT_NEAR(curve.top(x).span, std::exp(-residual.value(shape.q(x))), 1e-5) << x;
  }
}

/// Asked without a table, to its error; before the onset, within and beyond the end.
TEST(TabulateCurve, IsTheLawThatCanBeAsked)
{
  const LawShape shape = shape_with([](double u) { return 2 * u * u; }, [](double u) { return 2.2 * u * u; });
  const ContactLaw law(shape, 0.8 * end);
  const Curve curve = tabulate(law);
  for (double x = 0.01 * onset; x < 2 * end; x *= 1.07) {
    EXPECT_NEAR(law.force(x) / curve.force(x), 1, 4e-6) << x;
    if (x < law.end()) {
      EXPECT_NEAR(law.radius(x) / curve.radius(x), 1, 1e-5) << x;
    }
    EXPECT_NEAR(law.work(x) / curve.work(x), 1, 4e-6) << x;
    EXPECT_NEAR(law.kept(x), curve.kept(x), 1e-5) << x;
    EXPECT_NEAR(law.reversal(x).residual() / x, curve.reversal(x).residual() / x, x > onset ? 1e-4 : 2e-3) << x;
    EXPECT_NEAR(law.overlap_at_work(law.work(x)) / x, 1, 1e-9) << x;
  }
}

/// Losses that fall, jump or scatter: the work lost does not fall.
TEST(TabulateCurve, LosesNoLessFurtherOnWhateverTheLosses)
{
  using Losses = std::function<double(double)>;
  const Losses scattering = [](double u) { return u * u * (1 + 0.3 * std::sin(40 * u)); },
               jumping = [](double u) { return u < 0.5 ? 0.0 : 0.5; }, nothing = [](double) { return 0.0; },
               falling = [](double u) { return 3 * u * std::exp(-4 * u); };
  for (const Losses& dissipation : {scattering, jumping, nothing, falling}) {
    const Curve curve = tabulate(shape_with(nothing, dissipation), end);
    double before = 0;
    for (double x = onset * (1 + 1e-9); x < end; x *= 1.003) {
      EXPECT_GE(curve.lost(x), before * (1 - 1e-14)) << x;  // rounding
      before = curve.lost(x);
    }
  }
}

/// At a reversal unloading is not softer than loading, from the onset on, where both are the elastic curve's.
TEST(TabulateCurve, UnloadsNoSofterThanItLoads)
{
  const Curve curve = tabulate(
      shape_with([](double u) { return 2 * u * u; }, [](double u) { return 2.2 * u * u; }), end);
  for (double x = onset * (1 + 1e-9); x < end; x *= 1.01)
    // 1e-4: the fraction between nodes
    EXPECT_GE(curve.reversal(x).stiffness(x), curve.loading(x).stiffness * (1 - 1e-4)) << x;
}

TEST(TabulateCurve, MakesALoadingForceRise)
{
  LawShape shape = shape_with([](double u) { return u; }, [](double u) { return u; });
  shape.force_reduction.back() = 4;  // the last node falls
  const Curve curve = tabulate(shape, end);
  double before = 0;
  for (double x = 0.5 * end; x < end; x *= 1.001) {
    EXPECT_GE(curve.force(x), before);
    before = curve.force(x);
  }
}

TEST(TabulateCurve, RefusesATableThatIsNoLaw)
{
  CurveTable table = tabulate({ElasticCorrection{}, 0.1}).table();
  table.force.value[7] = 0;
  EXPECT_THROW(fitted_curve(table), Error);
}

}  // namespace granulaw::tabulate_curve_test
