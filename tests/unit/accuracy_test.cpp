#include "solver/run/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace granulaw::accuracy_test {

/// F = 1 + 0.01 (24/n)^1.65, e = 0.5, of the grid that was made.
RunResult made(int cells)
{
  RunResult r;
  r.summary.resolution = cells;
  r.summary.restitution = 0.5;
  r.summary.force_max = 1 + 0.01 * std::pow(24. / cells, 1.65);
  r.summary.cpu_s = 1;
  return r;
}

TEST(Accuracy, OneGridSaysNothingOfItsError)
{
  EXPECT_TRUE(std::isinf(error_between(made(24), made(24))));
  // the true error is 0.0099, whatever the ratio of the cells; the safety is 1.25
  for (const int coarse : {12, 17, 21})
    EXPECT_NEAR(error_between(made(24), made(coarse)), 1.25 * 0.01 / 1.01, 1e-12) << coarse;
}

TEST(Accuracy, TheErrorOfForceAndRestitutionIsOneRule)
{
  RunResult coarse = made(17);
  coarse.summary.restitution = 0.501;  // 0.2 %; the force differs by 0.76 %
  CellsError found = error_of_cells(made(24), coarse);
  EXPECT_NEAR(found.force, 1.25 * 0.01 / 1.01, 1e-12);
  EXPECT_EQ(found.restitution, found.force);  // two e may agree by chance
  coarse.summary.restitution = 0.51;
  found = error_of_cells(made(24), coarse);
  EXPECT_NEAR(found.restitution, rule_of_revolution.left(0.02, 24. / 17), 1e-12);
  EXPECT_EQ(error_between(made(24), coarse), found.restitution);
  RunResult noisy = made(24);
  noisy.summary.grid_noise = 0.06;  // of which a half is more than the change of e
  EXPECT_NEAR(error_between(noisy, coarse), rule_of_revolution.left(0.03, 24. / 17), 1e-12);
  EXPECT_EQ(error_of_cells(noisy, coarse).restitution, found.restitution);  // a fit goes through the noise
  RunResult spatial = made(24);
  spatial.planes.resize(1);
  EXPECT_NEAR(error_of_cells(spatial, made(12)).force, std::abs(made(12).summary.force_max / 1.01 - 1), 1e-12);
}

TEST(Accuracy, ExtrapolatesTheMeanOfChangesAndKeepsTheirScatter)
{
  EXPECT_NEAR(spatial_rule.left(std::vector<double>{0.02, 0.02, 0.02}, 1.5), 0.04, 1e-12);
  EXPECT_NEAR(spatial_rule.left(std::vector<double>{0.01, -0.01}, 1.5), std::sqrt(2 * 2e-4), 1e-12);
}

/// Thin layers make one grid of all cells from 15 to 24.
TEST(Accuracy, AnEstimateComparesWithTheNextGridThatIsAnother)
{
  std::vector<int> asked;
  const granulaw::Run run = [&](const RunOptions& options) {
    asked.push_back(options.resolution);
    return made(options.resolution > 14 ? 24 : options.resolution);
  };
  RunOptions options;
  options.resolution = 24;
  const RunResult found = run_with_estimate(options, run);
  EXPECT_EQ(asked, (std::vector<int>{24, 17, 12}));
  EXPECT_EQ(found.summary.error_estimate, error_between(made(24), made(12)));
  EXPECT_EQ(found.summary.cpu_s, 3);
  const granulaw::Run one_grid = [](const RunOptions&) { return made(24); };
  EXPECT_TRUE(std::isinf(run_with_estimate(options, one_grid).summary.error_estimate));
}

/// Two cells in a layer: 9 and 12 cells across the block are one grid.
TEST(Accuracy, ARunStatesTheCellsOfItsGrid)
{
  Material m;
  m.density = 1, m.youngs_modulus = 0.91, m.poisson_ratio = 0.3, m.yield_stress = 0.01;
  Particle sphere = Particle::sphere(1, m);
  Material skin = m;
  skin.youngs_modulus *= 2, skin.yield_stress *= 3;
  sphere.materials.push_back(skin);
  sphere.layers.push_back({0.08, 1});
  const auto summary = [&](int cells) {
    RunOptions options;
    options.resolution = cells, options.shifted_grids = 1, options.precision = Precision::single;
    return impact(sphere, {0.02}, {}, options).summary;
  };
  const RunSummary fewer = summary(9), more = summary(12);
  ASSERT_EQ(fewer.points, more.points);
  EXPECT_EQ(fewer.force_max, more.force_max);
  EXPECT_EQ(fewer.resolution, more.resolution);
  EXPECT_GE(more.resolution, 12);
}

}  // namespace granulaw::accuracy_test
