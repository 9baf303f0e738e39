#include "characterise/atlas_file.hpp"
#include "calibrate/flow_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/scales.hpp"
#include "calibrate/sphere_laws.hpp"
#include "atlas/tabulate_curve.hpp"

namespace granulaw {
namespace {

constexpr double stiffness = 150, poisson_ratio = 0.3;

const Atlas& atlas()
{
  static const Atlas read = read_atlas(GRANULAW_ATLAS_FILE);
  return read;
}

double e_over_y()
{
  return stiffness * (1 - poisson_ratio * poisson_ratio);
}

TEST(FlowShape, OfLinearHardeningIsTheAtlas)
{
  const double hardening = 0.02;
  const LawShape flow = flow_shape(atlas(), stiffness, poisson_ratio,
                                   [&](double strain) { return 1 + hardening * e_over_y() * strain; });
  const LawShape linear = atlas().shape({stiffness, poisson_ratio, hardening});
  for (std::size_t k = 0; k < LawShape::nodes; ++k) {
    // one hardening at all strains: rounding
    EXPECT_NEAR(flow.force_reduction[k], linear.force_reduction[k], 1e-10);
    EXPECT_NEAR(flow.dissipation[k], linear.dissipation[k], 1e-10);
  }
}

TEST(FlowShape, OfHardeningThatSaturatesLiesBetween)
{
  const double onset = onset_overlap(stiffness, 1.0, poisson_ratio);
  const auto force = [&](const FlowCurve& flow, double x) {
    return tabulate(flow_shape(atlas(), stiffness, poisson_ratio, flow), onset, Atlas::depth, 0.3)
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

TEST(Departure, IsWhatIsAddedToGetTheOwnLaw)
{
  const double onset = onset_overlap(stiffness, 1.0, poisson_ratio);
  const auto curve = [&](const LawShape& shape) {
    return tabulate(shape, onset, Atlas::depth, Atlas::depth);
  };
  const LawShape a = atlas().shape({stiffness, poisson_ratio, 0}),
                 b = atlas().shape({stiffness, poisson_ratio, 0.005});
  LawShape sum = a;
  sum.add(1, departure(curve(b), curve(a)));
  for (const double r : {3.0, 20.0, 200.0}) {
    const double x = r * onset;
    // between nodes 0.13 apart in ln(overlap), and through the tables' admissibility
    EXPECT_NEAR(curve(sum).loading(x).force / curve(b).loading(x).force, 1, 1e-3);
    EXPECT_NEAR(curve(sum).reversal(x).residual() / curve(b).reversal(x).residual(), 1, 5e-3);
  }
}

}  // namespace
}  // namespace granulaw
