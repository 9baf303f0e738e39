#include "atlas/guide.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "atlas/departure.hpp"
#include "atlas/tabulate_curve.hpp"
#include "base/scales.hpp"
#include "own_atlas.hpp"

namespace granulaw::guide_test {

using tests::atlas;

constexpr double stiffness = 150, poisson_ratio = 0.3;

double e_over_y()
{
  return stiffness * (1 - poisson_ratio * poisson_ratio);
}

TEST(StandIn, OfLinearHardeningIsTheAtlas)
{
  const double hardening = 0.02;
  const LawShape flow = stand_in(atlas(), stiffness, poisson_ratio,
                                   [&](double strain) { return 1 + hardening * e_over_y() * strain; });
  const LawShape linear = atlas().shape({stiffness, poisson_ratio, hardening});
  for (std::size_t k = 0; k < LawShape::nodes; ++k) {
    // one hardening at all strains: rounding
    EXPECT_NEAR(flow.force_reduction[k], linear.force_reduction[k], 1e-10);
    EXPECT_NEAR(flow.dissipation[k], linear.dissipation[k], 1e-10);
  }
}

TEST(StandIn, OfHardeningThatSaturatesLiesBetween)
{
  const auto force = [&](const FlowCurve& flow, double x) {
    return tabulate(stand_in(atlas(), stiffness, poisson_ratio, flow), 0.3)
        .loading(x)
        .force;
  };
  const FlowCurve soft = [](double) { return 1.0; },
                  voce = [](double strain) { return 2 - std::exp(-strain / 0.05); };
  for (const double x : {0.01, 0.05, 0.2}) {
    EXPECT_GT(force(voce, x), 1.01 * force(soft, x));
    EXPECT_LT(force(voce, x), 2 * force(soft, x));
  }
}

MaterialRatios of_hardening(double h)
{
  return {stiffness, poisson_ratio, h};
}

/// A departure measured at one stiffness is added there and at others.
TEST(Departure, IsAddedToTheGuideToGetTheOwnLaw)
{
  const LawShape guide = atlas().shape(of_hardening(0)), own = atlas().shape(of_hardening(0.005));
  const Curve law = tabulate(own, 0.3);
  LawShape sum = guide;
  const Departure departure = Departure::between(law, guide);
  departure.add_to(sum);
  const Curve found = tabulate(sum, Atlas::depth);
  for (const double r : {1.5, 3.0, 20.0, 200.0}) {
    const double x = r * own.onset;
    // a spline of 24 intervals
    EXPECT_NEAR(found.force(x) / law.force(x), 1, 1e-3) << r;
    EXPECT_NEAR(std::sqrt(found.kept(x) / law.kept(x)), 1, 1e-3) << r;
    EXPECT_NEAR(found.reversal(x).residual() / law.reversal(x).residual(), 1, 5e-3) << r;
  }
  EXPECT_NEAR(departure.end() * own.onset, 0.3, 1e-12);
  for (std::size_t f = 0; f < LawShape::functions.size(); ++f) {
    EXPECT_EQ(departure.at(f, 1), 0);
    EXPECT_EQ(departure.at(f, 2 * departure.end()), departure.at(f, departure.end()));
    EXPECT_EQ(Departure().at(f, 10), 0);
  }
}

/// Two runs, or one: no swing between the onset and them.
TEST(Departure, OfFewRunsDoesNotSwing)
{
  Departure::Points points;
  points[3] = {{30, 0.008}, {900, 0.02}};
  points[0] = {{900, 0.02}};
  const Departure departure(points);
  // the penalty takes 1 % of a difference
  EXPECT_NEAR(departure.at(3, 30), 0.008, 1e-4);
  EXPECT_NEAR(departure.at(3, 900), 0.02, 2e-4);
  EXPECT_NEAR(departure.at(0, 900), 0.02, 2e-4);
  for (double r = 1; r < 1e4; r *= 1.3)
    for (const std::size_t f : {0u, 3u}) {
      EXPECT_GE(departure.at(f, r), -1e-5) << r;
      EXPECT_LE(departure.at(f, r), 0.025) << r;
    }
}

TEST(Guide, OfAMaterialOfTheAtlasIsItsLawAndStatesItsError)
{
  const MaterialRatios m = of_hardening(0.02);
  const Guide guide = guide_of(atlas(), {m, {}}, onset_of(m), Atlas::depth);
  EXPECT_EQ(guide.master.dissipation, atlas().shape(m).dissipation);
  EXPECT_EQ(guide.error_force, atlas().claimed_force());
  const Guide voce = guide_of(atlas(), {m, [](double strain) { return 2 - std::exp(-strain / 0.05); }},
                              onset_of(m), Atlas::depth);
  EXPECT_TRUE(std::isinf(voce.error_force));
  EXPECT_NE(why_no_guide(atlas(), {{10, 0.3, 0}, {}}), "");
  EXPECT_EQ(why_no_guide(atlas(), {{1e5, 0.3, 0}, {}}), "");
}

/// Beyond the stiffest material of the atlas at the same overlap/onset.
TEST(Guide, OfAStifferMaterialHasTheLawAtTheSameOverlapOverTheOnset)
{
  const MaterialRatios stiffest{5000, 0.3, 0}, stiffer{8000, 0.3, 0};
  const LawShape known = atlas().shape(stiffest),
                 guide = guide_of(atlas(), {stiffer, {}}, onset_of(stiffer), 0.1).master;
  EXPECT_EQ(guide.end, 0.1);
  for (const double r : {3.0, 30.0, 300.0})
    EXPECT_NEAR(guide.by_q(&LawShape::dissipation).value(guide.q(r * guide.onset)),
                known.by_q(&LawShape::dissipation).value(known.q(r * known.onset)), 0.02)
        << r;
}

/// Over a core half as stiff the same force needs more overlap; over a stiffer one the functions stay.
TEST(Guide, OfASkinFollowsTheBodysElasticCurve)
{
  const MaterialRatios m{200, 0.3, 0.01};
  const LawShape sphere = atlas().shape(m);
  ElasticCorrection soft = sphere.elastic, stiff = sphere.elastic;
  soft.c1 -= 2, stiff.c1 += 2;
  const Guide on_soft = guide_of(atlas(), {m, {}}, sphere.onset, 0.1, &soft),
              on_stiff = guide_of(atlas(), {m, {}}, sphere.onset, 0.1, &stiff);
  const Curve law = tabulate(sphere, 0.1), softer = tabulate(on_soft.master, 0.1);
  for (const double x : {2e-3, 1e-2, 4e-2}) {
    const double deeper = x + 2.0 / 3 * 2 * law.force(x);
    EXPECT_NEAR(softer.force(deeper) / law.force(x), 1, 2e-3) << x;  // nodes
  }
  EXPECT_NEAR(on_stiff.master.by_q(&LawShape::dissipation).value(on_stiff.master.q(0.01)),
              sphere.by_q(&LawShape::dissipation).value(sphere.q(0.01)), 1e-3);
}

}  // namespace granulaw::guide_test
