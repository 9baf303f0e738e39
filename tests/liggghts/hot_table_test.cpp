#include "liggghts_plugin/hot_table.hpp"

#include <gtest/gtest.h>

#include <random>

#include "synthetic_law.hpp"

namespace granulaw::plugin {
namespace {

/// Largest difference of the hot table's force from the curve's, over the force at the turning point.
double worst_force(const ContactCurve& curve, const HotTable& table, double lowest)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> log_x(std::log(lowest), std::log(1.1 * curve.x_end())),
      part(0.0, 1.3);
  const auto wall = PairMapping::rigid_partner(1.0);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double x_max = std::exp(log_x(random)), x = x_max * part(random);
    const double expected = curve.evaluate(wall, 1.0, x, x_max).force / wall.force(1.0);
    const double found = table.force(x, x_max, x / x_max);
    EXPECT_GE(found, 0.0);
    worst = std::max(worst, std::abs(found - expected) / curve.loading(std::max(x, x_max)).force);
  }
  return worst;
}

TEST(HotTable, AgreesWithTheCurve)
{
  for (double onset : {6.4e-4, 6.4e-6}) {
    testing::SyntheticLaw law;
    law.onset = onset;
    const ContactCurve curve = law.curve();
    const HotTable table(curve);
    // An eighth of an octave and cubics: (1/8)^4/400 of a fourth derivative of order one is 1e-6; the steep
    // start of the residual at the onset (the synthetic law has a jump in curvature there) costs a decade.
    // The law itself is asked for 1e-3.
    EXPECT_LT(worst_force(curve, table, 1e-13), 2e-5) << onset;
  }
}

TEST(HotTable, AnElasticCurveStaysElastic)
{
  const Law law = testing::SyntheticLaw{}.law();
  const ContactCurve& curve = law.bodies.at("glass").curve;
  const HotTable table(curve);
  EXPECT_LT(worst_force(curve, table, 1e-9), 1e-6);  // smooth: no onset
  EXPECT_EQ(table.dissipated(0.01), 0.0);
}

TEST(HotTable, DissipatedWork)
{
  const ContactCurve curve = testing::SyntheticLaw{}.curve();
  const HotTable table(curve);
  for (double x : {1e-3, 3.3e-3, 1e-2, 0.05, 0.099, 0.12}) {
    const double expected = curve.work_loading(x) - curve.work_unloading(x);
    EXPECT_NEAR(table.dissipated(x), expected, 1e-4 * curve.work_loading(x)) << x;  // as the force
  }
  EXPECT_EQ(table.dissipated(0.5 * curve.onset()), 0.0);
}

}  // namespace
}  // namespace granulaw::plugin
