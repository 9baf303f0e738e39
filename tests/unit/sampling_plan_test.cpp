#include "characterise/run/sampling_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace granulaw::sampling_plan_test {

/// A skin on a core half as stiff: the graded grid has many lines beyond the block, and small steps.
TEST(SamplingPlan, ALayeredBodyCostsItsPointsTimesItsSteps)
{
  Particle coated = Particle::sphere(1e-3, {1200, 4.5e9, 0.3, 2e7, 0});
  coated.materials.push_back({1200, 9.1e9, 0.3, 2e7, 0});
  coated.layers.push_back({1e-4, 1});
  const CharacterisedBody body = characterised_body_of(coated);
  constexpr double step_of_point = 2.7e-8;  // CPU s, of a core that does nothing else
  const RunSource source;
  for (const double velocity : {4e-4, 3e-3}) {
    const RunJob job = impact_job(body, velocity, 8, 1, source);
    const RunSummary made = job.run({}).summary;
    const double cost = step_of_point * made.points * static_cast<double>(made.steps);
    // 1.01 and 1.16 seen; 0.28 and 0.56 without the lines beyond the block
    EXPECT_NEAR(std::log2(job.cost / cost), 0, 0.5) << velocity << ' ' << made.points << ' ' << made.steps << ' ' << job.cost;
  }
}

}  // namespace granulaw::sampling_plan_test
