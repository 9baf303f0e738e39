#include "liggghts_plugin/books/contact_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace granulaw::plugin::contact_statistics_test {

TEST(LogHistogram, BinsAreThoseOfTheLogarithm)
{
  const LogHistogram overlap{1e-10};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-11.0, 1.5);
  for (int k = 0; k < 100000; ++k) {
    const double value = std::pow(10.0, exponent(random));
    const double position = LogHistogram::per_decade * std::log10(value / overlap.first);
    if (std::abs(position - std::round(position)) < 1e-9)
      continue;  // on an edge the logarithm rounds either way
    const auto expected =
        static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, LogHistogram::bins - 1.0));
    ASSERT_EQ(overlap.bin(value), expected) << value;
  }
}

TEST(LogHistogram, EveryEdgeBelongsToTheBinAbove)
{
  // edges as the histogram has them; an octave holds two or three
  for (std::size_t b = 0; b + 1 < LogHistogram::bins; ++b) {
    const double edge = std::pow(10.0, (static_cast<double>(b) + 1.0) / LogHistogram::per_decade);
    const double below = std::nextafter(edge, 0.0), above = std::nextafter(edge, 2.0 * edge);
    EXPECT_EQ(LogHistogram::bin_of_ratio(below), b);
    EXPECT_EQ(LogHistogram::bin_of_ratio(edge), b + 1);
    EXPECT_EQ(LogHistogram::bin_of_ratio(above), b + 1);
    EXPECT_TRUE(LogHistogram::ends_above_ratio(b, below));
    EXPECT_FALSE(LogHistogram::ends_above_ratio(b, edge));
  }
  // where the octaves meet, against the logarithm: no edge is near but that of 1
  for (int k = 1; k < 40; ++k)
    for (const double ratio : {std::nextafter(std::ldexp(1.0, k), 0.0), std::ldexp(1.0, k)}) {
      const double position = std::floor(LogHistogram::per_decade * std::log10(ratio));
      EXPECT_EQ(LogHistogram::bin_of_ratio(ratio),
                static_cast<std::size_t>(std::min(position, LogHistogram::bins - 1.0)));
    }
  EXPECT_TRUE(LogHistogram::ends_above_ratio(LogHistogram::bins - 1, 1e300));
  EXPECT_EQ(LogHistogram::bin_of_ratio(std::numeric_limits<double>::quiet_NaN()), 0u);
}

TEST(LogHistogram, OuterBinsCatchTheRest)
{
  const LogHistogram speed{1e-6};
  EXPECT_EQ(speed.bin(0.0), 0u);
  EXPECT_EQ(speed.bin(-1.0), 0u);
  EXPECT_EQ(speed.bin(1e-300), 0u);
  EXPECT_EQ(speed.bin(1e300), LogHistogram::bins - 1u);
  EXPECT_EQ(speed.bin(std::numeric_limits<double>::infinity()), LogHistogram::bins - 1u);
  for (int b = 1; b < LogHistogram::bins; ++b) {
    EXPECT_EQ(speed.bin(speed.lower_edge(b) * (1 + 1e-12)), static_cast<std::size_t>(b));
    EXPECT_EQ(speed.bin(speed.lower_edge(b) * (1 - 1e-12)), static_cast<std::size_t>(b - 1));
  }
}

TEST(ContactStatistics, WhatEndedIsWhatBeganLessWhatIsOpen)
{
  ContactStatistics::Pair counts;
  const auto shallow = counts.overlap.bin(1e-5), deep = counts.overlap.bin(1e-2);
  for (int k = 0; k < 3; ++k) counts.count(shallow, 0.5, 1.0);  // three begin
  counts.count(shallow, 0.5, -1.0);                             // one of them grows deeper
  counts.count(deep, 0.5, 1.0);
  counts.count(shallow, 0.5, -1.0);  // one is open still
  counts.count_ended();
  EXPECT_EQ(counts.ended, 2);
  EXPECT_EQ(counts.overlap.count[shallow], 1);
  EXPECT_EQ(counts.overlap.count[deep], 1);
  EXPECT_LE(counts.overlap_min, 1e-5);
  EXPECT_GT(counts.overlap_min * std::pow(10.0, 1.0 / LogHistogram::per_decade), 1e-5);
}

TEST(ContactStatistics, ContactsOlderThanTheCountsLeaveNoneNegative)
{
  ContactStatistics::Pair counts;
  counts.count(5, -1.0, -1.0);
  counts.count(7, -1.0, 1.0);
  counts.count_ended();
  EXPECT_EQ(counts.overlap.count[5], 0);
  EXPECT_EQ(counts.ended, 1);
}

TEST(ContactStatistics, RowsOfTypesAreEachPairOnce)
{
  for (const int types : {1, 2, 3, 5}) {
    std::vector<int> seen(static_cast<std::size_t>(rows_of_types(types)));
    for (int i = 1; i <= types; ++i)
      for (int j = 1; j <= types; ++j) {
        if (i <= j) ++seen.at(static_cast<std::size_t>(row_of_types({PairKey::particles, i, j}, types)));
        ++seen.at(static_cast<std::size_t>(row_of_types({PairKey::rigid_wall, i, j}, types)));
      }
    for (const int count : seen) EXPECT_EQ(count, 1);
  }
  EXPECT_EQ(row_of_types({PairKey::particles, 1, 2}, 2), 1);
  EXPECT_EQ(row_of_types({PairKey::deformable_wall, 1, 1}, 2), 3);
}

/// The vector and the array of fix granulaw/stats have each place once; place 13 is the energy held, no count.
TEST(ContactStatistics, EveryPlaceOfTheFixHasOneQuantity)
{
  std::multiset<int> vector{13}, columns;
  for (const Quantity& q : quantities) {
    if (q.vector >= 0) vector.insert(q.vector);
    if (q.split) vector.insert(q.vector + 1);
    if (q.column >= 0) columns.insert(q.column);
  }
  ASSERT_EQ(vector.size(), 22u);  // fix_granulaw_stats.md
  ASSERT_EQ(columns.size(), 10u);
  int place = 0, column = 0;
  for (const int found : vector) EXPECT_EQ(found, place++);
  for (const int found : columns) EXPECT_EQ(found, column++);
}

}  // namespace granulaw::plugin::contact_statistics_test
