// Onset of yield of a body, by its elastic press.
#include "characterise/run/sampling_plan.hpp"
#include "characterise/run/onset_of_yield.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace granulaw::onset_of_yield_test {

constexpr double never = std::numeric_limits<double>::infinity();

/// A sphere of R = 1 mm under a skin of a tenth of it; E* of the skin 1 GPa.
CharacterisedBody coated(double core_yield, double skin_yield)
{
  Particle p = Particle::sphere(1e-3, {1000, 0.5e9, 0.3, core_yield, 0});
  p.materials.push_back({1000, 0.91e9, 0.3, skin_yield, 0});
  p.layers = {{1e-4, 1}};
  return characterised_body_of(p);
}

RunResult press_of(double depth, std::vector<double> yield_overlaps)
{
  RunResult press;
  press.summary.delta_max = depth;
  press.yield_overlaps = std::move(yield_overlaps);
  return press;
}

TEST(OnsetOfYield, OfAHomogeneousSphereIsHertzs)
{
  const CharacterisedBody sphere = characterised_body_of(100, 0.3, 0);
  EXPECT_EQ(onset_of_yield(sphere, press_of(0.02, {})), sphere.onset);
  EXPECT_EQ(pole_onset(sphere), sphere.onset);
}

TEST(OnsetOfYield, IsThatOfTheMaterialThatYieldsFirst)
{
  const CharacterisedBody body = coated(1e7, 1e8);
  ASSERT_EQ(body.pole_material, 1);
  const double pole = pole_onset(body);
  EXPECT_NEAR(pole, onset_overlap(1e9, 1e8, 0.3), 1e-3 * pole);
  EXPECT_EQ(onset_of_yield(body, press_of(0.04, {0.001, never})), 0.001);  // the core, at any overlap
  EXPECT_EQ(onset_of_yield(body, press_of(0.04, {never, never})), pole);
  EXPECT_EQ(onset_of_yield(body, press_of(0.04, {never, 0.01})), 0.01);  // the skin bends
}

/// One node of contact says nothing about the material under it.
TEST(OnsetOfYield, TheContactMustBeResolvedForTheMaterialAtThePole)
{
  const CharacterisedBody body = coated(1e8, 1e7);
  EXPECT_EQ(onset_of_yield(body, press_of(0.02, {never, 1e-4})), pole_onset(body));
}

TEST(OnsetOfYield, BeforeItsPressABodyIsTakenToYieldEarly)
{
  const CharacterisedBody body = coated(1e7, never);
  EXPECT_TRUE(body.yields());
  EXPECT_EQ(body.onset, onset_overlap(1.0, body.yield, 0.3));
  EXPECT_FALSE(coated(never, never).yields());
}

TEST(OnsetOfYield, ThePressOfABodyOfSeveralMaterialsAsksForIt)
{
  std::vector<std::vector<double>> asked;
  RunSource source;
  source.press = [&](const Particle& p, const PressPlan&, const RunOptions& o) {
    for (const Material& m : p.materials) EXPECT_FALSE(m.yields());
    asked.push_back(o.yield_stresses);
    return RunResult{};
  };
  elastic_press_job(coated(1e7, 1e8), 24, source).run({});
  elastic_press_job(characterised_body_of(100, 0.3, 0), 24, source).run({});
  EXPECT_EQ(asked, (std::vector<std::vector<double>>{{1e7, 1e8}, {}}));
}

}  // namespace granulaw::onset_of_yield_test
