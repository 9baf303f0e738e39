// Composed laws that a few impacts of the two bodies correct; `slow`: against a fresh impact.
#include "characterise/pair/two_body_runs.hpp"
#include "characterise/run/request.hpp"
#include "characterise/pair/corrected_law.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "law/radiation.hpp"
#include "law/replay.hpp"
#include "own_atlas.hpp"
#include "synthetic_law.hpp"

namespace granulaw::corrected_law_test {

LawMaterial material(const char* name, double e_star, double yield, double density)
{
  LawMaterial m;
  m.name = name, m.density = density, m.poisson_ratio = 0.3, m.youngs_modulus = e_star * 0.91;
  m.yield_stress = yield;
  return m;
}
constexpr double never = std::numeric_limits<double>::infinity();

/// A soft partner, whom composing serves worst.
class CorrectedLaw : public ::testing::Test
{
 protected:
  UnlikePair pair_{material("powder", 1, 0.02, 1), material("rubber", 0.2, never, 1), 1};
  const Atlas atlas_ = tests::atlas();
  const PairBody powder_{atlas_, pair_.yielding}, rubber_{atlas_, pair_.partner};
  BuildOptions options_;

  void SetUp() override { options_.atlas = &atlas_; }
};

using CorrectedLawSlow = CorrectedLaw;
TEST_F(CorrectedLawSlow, AgreesWithAFreshImpactAtAnyRatioOfRadii)
{
  const double ratios[] = {0.5, 0.7, 1, 1.4, 2};
  const CorrectedLaws made = corrected_laws(pair_, powder_, rubber_, ratios, options_);
  ASSERT_EQ(made.laws.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    UnlikePair at_ratio = pair_;
    at_ratio.radius_ratio = ratios[k];
    const BodyLaw& law = made.laws[k].law;
    EXPECT_TRUE(tests::loses_no_less_further_on(law.curve));
    EXPECT_GT(law.certificate.verification_impacts, 0);
    const double v = fastest_of_law(at_ratio, 1e-4);  // at 1e-3 the rubber is squeezed flat
    RunOptions run;
    run.resolution = 24, run.shifted_grids = 2;
    const RunSummary truth = run_two_bodies(at_ratio, v, run);
    const Replay replay = replay_collision(
        PairLaw{{&law.curve, at_ratio.mapping(), radiation(pair_.yielding, 1.0, pair_.partner, ratios[k])}, &law},
        at_ratio.r_eff(), at_ratio.m_eff(), v);
    // what the tolerance requires, of sampling and of the cells
    EXPECT_NEAR(replay.force_max / truth.force_max, 1, 2 * options_.tolerance) << ratios[k];
    EXPECT_NEAR(replay.restitution, truth.restitution, 2 * options_.tolerance) << ratios[k];
  }
}

/// A law of its own of one ratio of radii states what an impact left out shows.
TEST_F(CorrectedLaw, StatesWhatLeavingOneOutShows)
{
  options_.tolerance = 0.1;  // three impacts are enough
  options_.fastest = 0.05;
  const double one[] = {1};
  const CorrectedLaws made = corrected_laws(pair_, powder_, rubber_, one, options_);
  const Certificate& c = made.laws.front().law.certificate;
  // the deepest with fewer cells, to see that it can be followed and for the error of the cells; one to the onset
  EXPECT_EQ(made.runs, 6u);
  EXPECT_EQ(c.verification_impacts, 2);  // all but the deepest
  EXPECT_GT(c.verification_error_force, 0);
  EXPECT_LT(c.verification_error_force, options_.tolerance);
  EXPECT_LE(made.sampling_error, options_.tolerance);
}

}  // namespace granulaw::corrected_law_test
