#include "base/larger.hpp"
#include "characterise/fit/fit_curve.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "base/error.hpp"
#include "atlas/fit_spline.hpp"
#include "atlas/tabulate_curve.hpp"
#include "synthetic_law.hpp"

namespace granulaw::fit_curve_test {

using tests::SyntheticLaw;

/// A press as the solver would give it: the synthetic law with a grid noise that is periodic in the contact
/// radius, `cells` periods up to the largest, its amplitude falling as (1/cells passed)^1.65.
ContactRecord noisy_press(const Curve& curve, double depth, double grid_noise, int cells)
{
  ContactRecord press;
  press.depth = depth;
  press.residual = curve.reversal(depth).residual();
  press.hertz_share = curve.reversal(depth).shape().hertz_share;
  press.work_ratio = curve.kept(depth);
  const double a_max = curve.loading(depth).radius;
  for (int k = 1; k <= 400; ++k) {
    const double t = k / 400.0, x = depth * std::pow(std::sin(0.5 * M_PI * t), 2);
    const auto l = curve.loading(x);
    const double passed = cells * l.radius / a_max;
    const double swing = grid_noise * std::pow(std::max(1.0, passed) / cells, -1.65) *
                         std::sin(2 * M_PI * passed + depth * 1e4);
    press.loading.push_back({x, l.force * (1 + swing), l.radius});
  }
  return press;
}

std::vector<ContactRecord> presses(const Curve& curve, double grid_noise)
{
  std::vector<ContactRecord> all;
  for (int k = 0; k < 10; ++k)
    all.push_back(noisy_press(curve, 1e-3 * std::pow(100.0, k / 9.0), grid_noise, 12));
  return all;
}

const ElasticCorrection finite_sphere{SyntheticLaw::finite_sphere, 0, 0};

/// The law of presses alone.
struct FittedCurve
{
  Curve curve;
  FitQuality quality;
};
FittedCurve fit_presses(const std::vector<ContactRecord>& presses, double onset)
{
  ContactRecords records;
  records.slow = presses;
  const FittedShape fitted = fit_shape(records, finite_sphere, onset, 0.1);
  return {tabulate(fitted.shape, 0.1), fitted.quality};
}

/// Largest relative errors of a fitted curve against the law the presses were made from.
struct Errors
{
  double force = 0, e = 0, residual = 0;
};
Errors compare(const Curve& fitted, const Curve& truth)
{
  Errors errors;
  for (int k = 1; k <= 400; ++k) {
    const double x = std::pow(0.562 * k / 400, 4);
    errors.force = larger(errors.force, std::abs(fitted.loading(x).force / truth.loading(x).force - 1));
    if (x < 1.05 * truth.onset()) continue;
    const double e = std::sqrt(fitted.kept(x));
    const double exact = std::sqrt(truth.kept(x));
    errors.e = larger(errors.e, std::abs(e / exact - 1));
    errors.residual =
        larger(errors.residual, std::abs(fitted.reversal(x).residual() - truth.reversal(x).residual()) / x);
  }
  return errors;
}

TEST(FitCurve, RecoversALawFromSmoothPresses)
{
  const Curve truth = SyntheticLaw{}.curve();
  const FittedCurve fitted = fit_presses(presses(truth, 0.0), truth.onset());
  const Curve& curve = fitted.curve;
  const Errors errors = compare(curve, truth);
  // Resolution of ten reversal points a factor 1.67 apart; the tolerance of laws is 1 %.
  EXPECT_LT(errors.force, 1e-3);
  EXPECT_LT(errors.e, 1e-3);  // the same, and 1e-4: the work spared for rounding (law_shape.cpp)
  EXPECT_LT(errors.residual, 3e-3);
  EXPECT_TRUE(tests::loses_no_less_further_on(curve));
}

/// Four runs, each six times as deep as the one before, show what a guide is off by; without it they do not.
TEST(FitCurve, FewRunsShowTheDepartureFromAGuide)
{
  const Curve truth = SyntheticLaw{}.curve();
  ContactRecords all, few;
  all.slow = presses(truth, 0.0);
  for (const double depth : {5e-4, 3e-3, 0.018, 0.1}) {
    few.slow.push_back(noisy_press(truth, depth, 0.0, 12));
    few.slow.back().run_depth = depth;
  }
  LawShape guide = fit_shape(all, finite_sphere, truth.onset(), 0.1).shape;
  for (double& value : guide.force_reduction) value *= 0.9;
  for (double& value : guide.dissipation) value *= 1.1;
  const Errors off = compare(tabulate(guide, 0.1), truth);
  const Errors about = compare(tabulate(fit_about(guide, few).shape, 0.1), truth);
  const Errors alone = compare(tabulate(fit_shape(few, finite_sphere, truth.onset(), 0.1).shape, 0.1), truth);
  EXPECT_GT(off.force, 0.05);
  EXPECT_GT(off.e, 0.05);
  // a third of the tolerance of laws
  EXPECT_LT(about.force, 0.003);
  EXPECT_LT(about.e, 0.003);
  EXPECT_LT(about.e, 0.5 * alone.e);
}

/// At a speed between those of the guide, of what is linear in the speed.
TEST(FitCurve, AnImpactWithoutItsInertiaIsAPress)
{
  std::vector<LawShape::VelocityEffect> effects;
  for (const double v : {0.02, 0.05, 0.1}) {
    LawShape::VelocityEffect effect{v, 0, 0.2 * v, 0.1 * v, std::vector<double>(LawShape::VelocityEffect::shares, -0.3 * v)};
    effects.push_back(effect);
  }
  ContactRecord press;
  press.depth = 0.02, press.residual = 0.015, press.work_ratio = 0.3, press.peak = press.reversal_force = 1;
  press.loading = {{0.01, 0.4, 0.1}, {0.02, 1, 0.14}};
  ContactRecord impact = press;
  impact.speed = 0.07;
  const double force = std::exp(-0.021);
  for (ContactRecord::Sample& s : impact.loading) s.force *= force;
  impact.peak *= force, impact.reversal_force *= force;
  impact.work_ratio *= std::exp(-0.014);
  impact.residual = impact.depth * (1 - (1 - press.residual / press.depth) * std::exp(-0.007));
  const ContactRecord slow = without_inertia(impact, effects);
  EXPECT_EQ(slow.speed, 0);
  EXPECT_NEAR(slow.loading[0].force, 0.4, 1e-12);
  EXPECT_NEAR(slow.peak, 1, 1e-12);
  EXPECT_NEAR(slow.reversal_force, 1, 1e-12);
  EXPECT_NEAR(slow.work_ratio, press.work_ratio, 1e-12);
  EXPECT_NEAR(slow.residual, press.residual, 1e-12);
}

TEST(FitCurve, DoesNotFollowTheContactEdgeNoise)
{
  const Curve truth = SyntheticLaw{}.curve();
  const FittedCurve smooth = fit_presses(presses(truth, 0.0), truth.onset());
  const FittedCurve noisy = fit_presses(presses(truth, 0.01), truth.onset());
  const Curve &a = smooth.curve, &b = noisy.curve;
  double largest = 0;
  for (int k = 160; k <= 400; ++k) {
    const double x = std::pow(0.562 * k / 400, 4);
    largest = larger(largest, std::abs(b.loading(x).force / a.loading(x).force - 1));
  }
  // 1 % at the reversal of every press, more before it; 0.5 % in F is required after treatment
  EXPECT_LT(largest, 5e-3);
  EXPECT_GT(noisy.quality.scatter, 0.005) << "the scatter must say that the runs were noisy";
  EXPECT_LT(smooth.quality.scatter, 0.002);
}

/// Force over Hertz's of an elastic body with a skin of 0.03 R on a core half as stiff: it changes where the
/// contact is as wide as the skin is thick.
double layered(double x)
{
  const double wide = std::sqrt(x) / 0.03;
  return 1 - 0.5 * wide * wide / (1 + wide * wide);
}

ContactRecord layered_press(double depth)
{
  ContactRecord press;
  press.depth = depth;
  for (int k = 1; k <= 400; ++k) {
    const double x = depth * k / 400;
    press.loading.push_back({x, std::pow(x, 1.5) * layered(x), std::sqrt(x)});
  }
  return press;
}

TEST(FitElastic, OfSeveralMaterialsFollowsThePressesOwnPoints)
{
  constexpr double onset = 1e-3, depth = 0.02;
  const ContactRecord press = layered_press(depth);
  const std::vector<ContactRecord> slow{layered_press(1.3e-3), layered_press(0.0075)};
  const ElasticCorrection terms = fit_elastic(press), measured = measured_elastic(press, slow, onset);
  double of_terms = 0, of_measured = 0, of_slope = 0;
  for (double x = 1e-4; x < depth; x *= 1.1) {
    const double s = std::pow(x, 0.25), step = 1e-5 * s;
    of_terms = larger(of_terms, std::abs(terms.force_ratio(s) / layered(x) - 1));
    of_measured = larger(of_measured, std::abs(measured.force_ratio(s) / layered(x) - 1));
    const double slope = (measured.force_ratio(s + step) - measured.force_ratio(s - step)) / (2 * step);
    of_slope = larger(of_slope, std::abs(measured.force_ratio_slope(s) - slope));
  }
  EXPECT_GT(of_terms, 0.05);
  EXPECT_LT(of_measured, 0.005);  // half of the tolerance of most laws
  EXPECT_LT(of_slope, 1e-6);      // central differences
  EXPECT_EQ(measured.force_ratio(0), 1);
}

/// Shape of a body that yields: numbers like those of E*/Y = 500.
LawShape sphere_shape(double onset = 2.6e-5, double end = 0.1)
{
  LawShape shape = LawShape::zero(onset, end);
  shape.elastic = finite_sphere;
  for (int k = 0; k < LawShape::nodes; ++k) {
    const double u = k / (LawShape::nodes - 1.0);
    const auto n = static_cast<std::size_t>(k);
    shape.force_reduction[n] = 3.0 * u * u, shape.widening[n] = 0.3 * u * u;
    shape.residual[n] = 2.5 * u * u, shape.dissipation[n] = 2.0 * u * u;
  }
  return shape;
}

TEST(LawShape, ASkinOnTheSameBodyIsTheSphere)
{
  const double known = 4e-4;
  const LawShape sphere = sphere_shape(), skin = sphere.as_skin_of(sphere.elastic, known);
  for (std::size_t k = 0; sphere.overlap(k) < known; ++k) {
    // 1e-3: of losses, the 2e-4 of the work that a table spares for rounding, and its cubics
    EXPECT_NEAR(skin.force_reduction[k], sphere.force_reduction[k], 1e-4) << k;
    EXPECT_NEAR(skin.widening[k], sphere.widening[k], 1e-4) << k;
    EXPECT_NEAR(skin.residual[k], sphere.residual[k], 1e-4) << k;
    EXPECT_NEAR(skin.dissipation[k], sphere.dissipation[k], 1e-3) << k;
  }
}

/// On a softer body the same force needs more overlap, and loses the same energy.
TEST(LawShape, ASkinOnASofterBodyLosesTheSameAtTheSameForce)
{
  const double known = 4e-4;
  const LawShape sphere = sphere_shape();
  ElasticCorrection body = sphere.elastic;
  body.c1 = -4.5;
  const double compliance = 2.0 / 3.0 * (sphere.elastic.c1 - body.c1);
  const Curve on_sphere = tabulate(sphere, known),
                     on_body = tabulate(sphere.as_skin_of(body, known), known);
  for (const double x : {8e-5, 1.4e-4, 1.9e-4}) {  // to half of what is known, as it is used
    const double force = on_sphere.loading(x).force, deeper = x + compliance * force;
    // 1e-3: a cubic in x between 49 nodes over eight e-folds
    EXPECT_NEAR(on_body.loading(deeper).force / force, 1.0, 1e-3) << x;
    const auto lost = [](const Curve& c, double at) {
      return c.lost(at);
    };
    EXPECT_NEAR(lost(on_body, deeper) / lost(on_sphere, x), 1.0, 1e-2) << x;
    EXPECT_NEAR(on_body.reversal(deeper).residual() / on_sphere.reversal(x).residual(), 1.0, 5e-3) << x;
  }
}

/// A Hertz coefficient that runs between its bounds (an unloading that rises, losses as computed) meets them
/// anywhere between two nodes: none of these stiff bodies may be refused for it.
TEST(LawShape, AnUnloadingMayMeetTheBoundsOfOneThatRisesBetweenNodes)
{
  for (const double residual : {1.0, 1.5, 2.0})
    for (const double dissipation : {2.0, 3.0})
      for (const double hertz_share : {-1.0, 0.0, 2.0}) {
        LawShape shape = sphere_shape(2.6e-7, 0.2);
        for (int k = 0; k < LawShape::nodes; ++k) {
          const double u = k / (LawShape::nodes - 1.0);
          const auto n = static_cast<std::size_t>(k);
          shape.residual[n] = residual * u * u, shape.dissipation[n] = dissipation * u * u;
          shape.hertz_share[n] = hertz_share * u;
        }
        EXPECT_NO_THROW(tabulate(shape, 0.2))
            << residual << ' ' << dissipation << ' ' << hertz_share;
      }
}

TEST(FitCurve, ElasticFitRecoversItsCoefficients)
{
  ContactRecord press;
  press.depth = 0.004;
  for (int k = 1; k <= 300; ++k) {
    const double x = press.depth * k / 300, r = std::sqrt(x);
    press.loading.push_back({x, x * r * (1 + 0.87 * r + 0.4 * x), r * (1 - 0.2 * r)});
  }
  const ElasticCorrection fit = fit_elastic(press);
  EXPECT_NEAR(fit.c1, 0.87, 1e-9);  // exact least squares
  EXPECT_NEAR(fit.c2, 0.4, 1e-8);
  EXPECT_NEAR(fit.d1, -0.2, 1e-9);
  const Curve curve = tabulate({fit, 0.1});
  // 3.6e-7: a cubic between nodes h = x/8 apart, of x^1.5: (h/x)^4/384 times 9/16
  for (const double x : {1e-6, 1e-3, 0.03})
    EXPECT_NEAR(curve.loading(x).force / (std::pow(x, 1.5) * (1 + 0.87 * std::sqrt(x) + 0.4 * x)), 1, 3.6e-7);
}

/// phi(u) from x = 0.1 to `residual`, then nothing to the overlap `touched`.
UnloadingPath path_of(const UnloadingShape& shape, double residual, double touched)
{
  UnloadingPath path;
  constexpr int count = 2000;
  for (int k = 0; k <= count; ++k) {
    const double u = 1 - static_cast<double>(k) / count;
    path.push_back({residual + (0.1 - residual) * u, shape.at(u).value});
  }
  if (touched < residual) path.push_back({touched, 0});
  return path;
}

TEST(ContactRecord, UnloadingOfTheLawsShapeIsRecovered)
{
  for (const UnloadingShape& shape :
       {UnloadingShape{1.2, 1.5}, {1.5, 1.0}, {1.5, 0.3}, {1.9, 0.1}, {2.0, 0}}) {
    const UnloadingPath path = path_of(shape, 0.06, 0.06);
    const UnloadingFit fit = fit_unloading(path, 1);
    // the path's straight pieces leave 2e-7; a Hertz coefficient is 50 times as sensitive
    EXPECT_NEAR(fit.residual, 0.06, 1e-6);
    EXPECT_NEAR(fit.hertz_share, shape.hertz_share, 1e-3);
    EXPECT_NEAR(residual_as_long(path, 1, shape.hertz_share), 0.06, 1e-6);
  }
}

TEST(ContactRecord, UnloadingEndsWhereItTakesAsLong)
{
  // After u^1.5 the body coasts over 0.002 at its speed of rebound: all that it adds to the time is 0.002/V,
  // and with t(r) = (x_m - r)/V f, f = int du/sqrt(1 - W(u)/W(1)) of the shape that gives the work back over
  // that span, the r asked for obeys t(r) = t(0.06) + 0.002/V.
  const double residual = residual_as_long(path_of({1.5, 1}, 0.06, 0.058), 1, 1);
  const double work = 0.04 / 2.5;
  const auto time = [&](double r) {
    const UnloadingShape shape{UnloadingShape::exponent_of(work / (0.1 - r), 1), 1};
    const auto of_v = [&](double v) { return 2 * v / std::sqrt(1 - shape.work(1 - v * v) / shape.work()); };
    return (0.1 - r) *
           boost::math::quadrature::gauss_kronrod<double, 61>::integrate(of_v, 0.0, 1.0, 10, 1e-10);
  };
  // Hertz's rebound: f = int du/sqrt(1 - u^2.5) = beta(0.4, 0.5)/2.5
  EXPECT_NEAR(time(0.06), 0.04 * std::beta(0.4, 0.5) / 2.5, 1e-8);
  EXPECT_NEAR(time(residual), time(0.06) + 0.002, 1e-6);
  EXPECT_LT(residual, 0.06);
  EXPECT_GT(residual, 0.055);
}

TEST(FitCurve, RefusesRunsThatContradictEachOther)
{
  const Curve truth = SyntheticLaw{}.curve();
  std::vector<ContactRecord> all = presses(truth, 0.0);
  all[5].work_ratio = 0.99;  // gives back more than the shallower press before it dissipated
  EXPECT_THROW(fit_presses(all, truth.onset()), Error);
}

TEST(Spline, StartsWithZeroValueAndSlopeAndReproducesACubic)
{
  std::vector<SplineSample> samples;
  for (int k = 1; k <= 60; ++k) {
    const double q = 1.5 * k / 60;
    samples.push_back({q, 2 * q * q - 0.5 * q * q * q, 1.0});
  }
  const Spline spline = fit_spline(samples, 1.5, 8, 1e-9);
  EXPECT_NEAR(spline.value(0.0), 0, 1e-12);
  EXPECT_NEAR(spline.slope(1e-9), 0, 1e-7);
  for (const double q : {0.1, 0.5, 1.0, 1.5}) {
    EXPECT_NEAR(spline.value(q), 2 * q * q - 0.5 * q * q * q, 1e-7);
    EXPECT_NEAR(spline.slope(q), 4 * q - 1.5 * q * q, 1e-6);
  }
}

}  // namespace granulaw::fit_curve_test
