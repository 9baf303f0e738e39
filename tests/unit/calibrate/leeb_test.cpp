#include "calibrate/leeb.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/error.hpp"
#include "calibrate/measurement_file.hpp"
#include "characterise/atlas_file.hpp"

namespace granulaw::leeb_test {

using testing::HasSubstr;

const Atlas& atlas()
{
  static const Atlas read = read_atlas(GRANULAW_ATLAS_FILE);
  return read;
}

CandidateMaterial steel()
{
  CandidateMaterial m;
  m.name = "steel", m.density = 7850, m.youngs_modulus = 210e9, m.poisson_ratio = 0.29;
  return m;
}

Measurement readings(const std::string& rows, const std::string& device = "D", double compliance = 0)
{
  Measurement m = parse_measurement("leeb_hardness\n" + rows, "readings.csv", *kinds().front());
  make_drops(m, leeb_device(device, "test"), compliance);
  return m;
}

double yield_of(Measurement m)
{
  CalibrationRequest r;
  complete_standard_deviations(m, 0.01);
  r.measurements = {m}, r.known = steel(), r.fit = {Parameter::yield_stress};
  const CalibrationProblem problem(atlas(), r);
  return calibrate(problem).parameters.front().profile.value;
}

TEST(Leeb, ReadingIsTheRatioOfSpeedsAtTheCoil)
{
  const Measurement m = readings("530\n");
  EXPECT_TRUE(m.is_leeb);
  EXPECT_DOUBLE_EQ(m.data[0].x, 2.05);
  // 1 mm of fall adds 2 g h to both squares: (.53^2 (2.05^2 - .01962) + .01962)/2.05^2
  EXPECT_NEAR(m.data[0].y, std::sqrt((0.53 * 0.53 * (2.05 * 2.05 - 0.01962) + 0.01962)) / 2.05, 1e-12);
}

// One reading suffices. The solver with the ball's density raised to the body's mass (mpm impact --impact-body-mass) has
// e .5167 at Y 1 GPa, HL 514.7: the composed law's bound there is .0082, 3 % of Y.
TEST(Leeb, YieldStressIsThatOfTheSolversRebound) { EXPECT_NEAR(yield_of(readings("514.7\n")), 1e9, 0.03e9); }

// An elastic body gives back what it stores, so a rebound needs less yield stress: 7 to 9 % at 1e-9 m/N.
TEST(Leeb, BodyThatGivesWayLowersTheYieldStress)
{
  const double ratio = yield_of(readings("530\n", "D", 1e-9)) / yield_of(readings("530\n"));
  EXPECT_GT(ratio, 0.90);
  EXPECT_LT(ratio, 0.94);
}

TEST(Leeb, ReferenceBlockGivesTheFactorOfItsTester)
{
  const Estimate95 factor = rate_factor_of(atlas(), readings("530\n"), 760, 570, steel());
  EXPECT_GT(factor.value, 1.15);  // as the conversion tables of steels (docs/evidence/leeb.md)
  EXPECT_LT(factor.value, 1.35);
  EXPECT_NEAR(std::log(factor.high / factor.low) / 2, 2 * std::hypot(0.054, 0.03), 0.03);  // hardness, reading and law
}

TEST(Leeb, DeviceWhoseBodyIsNoMassIsRefused)
{
  for (const auto& [name, sentence] : {std::pair{"DL", "slender body"}, std::pair{"F", "no impact device"}}) try {
      leeb_device(name, "--leeb");
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), HasSubstr(sentence));
    }
  EXPECT_THROW(parse_measurement("leeb_hardness\n1000\n", "readings.csv", *kinds().front()), Error);
}

}  // namespace granulaw::leeb_test
