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
  const auto begin = [](const Measurement& m) { return m.unloadings().front().first; };
  EXPECT_EQ(begin(full), 5u);
  const Measurement thinned = parse_measurement(loading + "4,4\n4.2,3.4\n3.5,2\n3,0\n", "x");
  EXPECT_EQ(thinned.reversal(), 5u);
  EXPECT_EQ(begin(thinned), 5u);
  EXPECT_EQ(thinned.unloadings().front().gap, 1);
  EXPECT_TRUE(parse_measurement(loading + "4,4\n5,3\n", "x").unloadings().empty());
}

TEST(MeasurementFile, UnloadingsAreFoundInTheirOrder)
{
  Measurement m;
  m.kind = &kind_named("platens", "test");
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{
           {0, 0}, {1, 1}, {2, 2}, {1.9, 1.2}, {1.95, 1.6}, {2, 2}, {3, 3}, {4, 4}, {3.8, 2}, {4, 4}, {5, 5}, {4.6, 1}, {4.5, 0}})
    m.data.push_back({x, y, 0, 1});
  const std::vector<Unloading> cycles = m.unloadings();
  ASSERT_EQ(cycles.size(), 3u);
  EXPECT_EQ(cycles[0].first, 3u);
  EXPECT_EQ(cycles[0].last, 5u);
  EXPECT_EQ(cycles[1].first, 8u);
  EXPECT_EQ(cycles[1].last, 9u);
  EXPECT_EQ(cycles[2].first, 11u);
  EXPECT_EQ(cycles[2].last, 13u);
  // a displacement that scatters recedes without a fall of the force
  for (std::size_t k = 6; k < 8; ++k) m.data.insert(m.data.begin() + 7, {2.98, 3.0, 0, 1});
  EXPECT_EQ(m.unloadings().size(), 3u);
}

/// The same two drops, however they are written.
TEST(MeasurementFile, SpreadsheetsAreRead)
{
  const std::string header = "velocity_m_per_s;restitution\n";
  for (const std::string& text : std::vector<std::string>{
           header + "1,5;0,8\n2,5;0,75\n",
           "\xef\xbb\xbf" + header + "1,5;0,8\r\n2,5;0,75\r\n",
           header + "1.5;0.8\r2.5;0.75\r",
           "velocity_m_per_s\trestitution\n1,5\t0,8\n2,5\t0,75\n",
           "velocity_m_per_s   restitution\n1.5  0.8\n2.5 0.75\n",
           "sep=;\n" + header + "1,5;0,8;\n;;\n2,5;0,75;;\n",
           "\"velocity_m_per_s\",\"restitution\"\n\"1,5\",\"0,8\"\n\"2,5\",\"0,75\"\n",
           "\"# drops, of March\";\n\"Velocity_m_per_s\";\"Restitution\"\n1,5;0,8\n2,5;0,75\n",
           "velocity;restitution\nm/s;-\n1,5;0,8\n2,5;0,75\n",
           "velocity_m_per_s,restitution\n[m/s],\n1.5,0.8\n2.5,0.75\n",
           "Velocity [m/s];Restitution\n1,5E+00;0,8\n2,5;7,5e-1\n"}) {
    const Measurement m = parse_measurement(text, "x.csv");
    ASSERT_EQ(m.data.size(), 2u) << text;
    EXPECT_EQ(m.data[0].x, 1.5) << text;
    EXPECT_EQ(m.data[0].y, 0.8) << text;
    EXPECT_EQ(m.data[1].y, 0.75) << text;
  }
  const Measurement one = parse_measurement("hardness_Pa\n2,5e8\n2,6e8\n", "x.csv");
  EXPECT_EQ(one.data[1].y, 2.6e8);
}

TEST(MeasurementFile, WhatMayMeanTwoThingsIsNamed)
{
  const std::string header = "velocity_m_per_s;restitution\n";
  EXPECT_THAT(complaint("velocity_m_per_s,restitution\n0,5,0,8\n"), HasSubstr("data.csv:2: the row has twice as many columns"));
  EXPECT_THAT(complaint(header + "0,5;0.8\n"), HasSubstr("data.csv:2: a number has a comma, that of line 2 a point"));
  EXPECT_THAT(complaint("hardness_Pa\n1,234\n1,250\n"), HasSubstr("may be a decimal one, or separate thousands: found '1,234'"));
  EXPECT_THAT(complaint(header + "1.234,5;0,8\n"), HasSubstr("'velocity_m_per_s' is no number"));
  EXPECT_THAT(complaint("displacement;force\nmm;N\n1;2\n"), HasSubstr("data.csv:2: the unit of 'displacement' is no SI unit of it: found 'mm', allowed is m"));
  EXPECT_THAT(complaint("displacement_m;force_N\nm;kN\n1;2\n"), HasSubstr("found 'kN', allowed is N"));
  EXPECT_THAT(complaint(header + "\"1;0,8\n"), HasSubstr("data.csv:2: a quote is not closed"));
  EXPECT_THAT(complaint(std::string("\xff\xfe" "v\0e\0", 6)), HasSubstr("no text of one byte a character"));
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
