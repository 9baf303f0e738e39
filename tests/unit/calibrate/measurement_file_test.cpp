#include "calibrate/measurement_file.hpp"

#include <gmock/gmock.h>

#include "calibrate/kind/kind.hpp"
#include "calibrate/noise.hpp"
#include "refusal.hpp"

namespace granulaw::measurement_file_test {

using testing::HasSubstr;

std::string complaint(const std::string& text)
{
  return sentence_of([&] {
    Measurement m = parse_measurement(text, "data.csv");
    complete_standard_deviations(m, 0.01);
  });
}

TEST(MeasurementFile, TellsTheKindByItsHeader)
{
  const Measurement m =
      parse_measurement("# a comment\nvelocity_m_per_s,restitution,restitution_sd\n1,0.8,0.01\n", "x");
  EXPECT_STREQ(m.kind->name, "restitution");
  ASSERT_EQ(m.data.size(), 1u);
  EXPECT_EQ(m.data[0].x, 1);
  EXPECT_EQ(m.data[0].y, 0.8);
  EXPECT_EQ(m.data[0].sd, 0.01);
  EXPECT_EQ(m.data[0].line, 3);
}

TEST(MeasurementFile, ACurveMayTurnBetweenItsRows)
{
  const std::string loading = "displacement_m,force_N\n0,0\n1,1\n2,2\n3,3\n";
  const Measurement full = parse_measurement(loading + "4,4\n3.5,2\n3,0\n", "x");
  EXPECT_EQ(full.loading_rows(), 5u);
  const Measurement thinned = parse_measurement(loading + "4,4\n4.2,3.4\n3.5,2\n3,0\n", "x");
  EXPECT_EQ(thinned.reversal(), 5u);
  EXPECT_EQ(thinned.loading_rows(), 5u);
  EXPECT_EQ(thinned.turn_gap(), 1);
  EXPECT_EQ(parse_measurement(loading + "4,4\n5,3\n", "x").turn_gap(), 0);
}

TEST(MeasurementFile, NoiseMayLiftRestitutionOverOne)
{
  EXPECT_EQ(complaint("velocity_m_per_s,restitution,restitution_sd\n0.1,1.004,0.03\n1,0.8,0.03\n"), "");
  EXPECT_THAT(complaint("velocity_m_per_s,restitution,restitution_sd\n0.1,1.14,0.03\n1,0.8,0.03\n"),
              HasSubstr("over 1 by more than its noise"));
}

TEST(MeasurementFile, ForcesArePlatensUnlessFlat)
{
  const std::string text = "displacement_m,force_N\n0,0\n1,1\n2,2\n3,3\n4,4\n3,2\n";
  EXPECT_STREQ(parse_measurement(text, "x").kind->name, "platens");
  const Kind& flat = kind_named("flat", "test");
  EXPECT_EQ(parse_measurement(text, "x", flat).kind, &flat);
  EXPECT_EQ(parse_measurement(text, "x").reversal(), 4u);
}

TEST(MeasurementFile, SaysWhatIsWrongInOneSentence)
{
  const std::string drops = "velocity_m_per_s,restitution\n";
  EXPECT_THAT(complaint("velocity,restitution\n1,0.5\n"), HasSubstr("must name its unit"));
  EXPECT_THAT(complaint("displacement_mm,force_N\n1,0.5\n"), HasSubstr("must name its unit"));
  EXPECT_THAT(complaint("speed,bounce\n1,2\n"), HasSubstr("names no kind"));
  EXPECT_THAT(complaint(drops + "1\n"), HasSubstr("another number of columns"));
  EXPECT_THAT(complaint(drops + "-1,0.5\n"), HasSubstr("data.csv:2: 'velocity_m_per_s' is out of range"));
  EXPECT_THAT(complaint(drops + "1,1.2\n"), HasSubstr("data.csv:2: 'restitution' is over 1"));
  EXPECT_THAT(complaint(drops + "1,-0.2\n"), HasSubstr("'restitution' is out of range"));
  EXPECT_THAT(complaint(drops + "1,nan\n"), HasSubstr("is not finite"));
  EXPECT_THAT(complaint(drops + "1,fast\n"), HasSubstr("is no number"));
  EXPECT_THAT(complaint(drops), HasSubstr("no row"));
  EXPECT_THAT(complaint(""), HasSubstr("empty"));
  EXPECT_THAT(complaint("displacement_m,force_N\n0,0\n1,1\n"), HasSubstr("more rows"));
  EXPECT_THAT(complaint("displacement_m,force_N\n3,0\n3.2,1\n3.4,2\n3.7,4\n4,7\n3,5\n2,3\n1,1\n0,0\n"),
              HasSubstr("data.csv: unloading gives back more work"));
}

}  // namespace granulaw::measurement_file_test
