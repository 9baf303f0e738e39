#include "liggghts_plugin/books/restart_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin::restart_record_test {

RestartRecord some_record()
{
  return {{1.5, -2.0, 3.0}, {{"pair", {40l + HistoryMeaning::energy, 2.5}}, {"walls", {41, 1.0}}}};
}

std::optional<RestartRecord> read(const std::vector<double>& numbers)
{
  return RestartRecord::from(reinterpret_cast<const char*>(numbers.data()));
}

TEST(RestartRecord, ComesBackAsItWas)
{
  for (const RestartRecord& record :
       {some_record(), RestartRecord{}, RestartRecord{{}, {{"w", {1, 1.0}}}}, RestartRecord{{1.0}, {}}}) {
    const std::optional<RestartRecord> back = read(record.numbers());
    ASSERT_TRUE(back);
    EXPECT_EQ(back->counts, record.counts);
    EXPECT_EQ(back->meanings, record.meanings);
  }
}

/// LIGGGHTS says nothing of a record's length: whatever its first numbers are, no byte beyond it is read.
TEST(RestartRecord, IsRefusedWhereItIsDamaged)
{
  const std::vector<double> whole = some_record().numbers();
  for (std::size_t k = 0; k < whole.size(); ++k)
    for (const double value : std::initializer_list<double>{std::nextafter(whole[k], 1e308), -1.0, NAN, INFINITY, 1e18, 0.5}) {
      if (value == whole[k]) continue;
      std::vector<double> damaged = whole;
      damaged[k] = value;
      EXPECT_FALSE(read(damaged)) << k << " " << value;
    }
  EXPECT_FALSE(read({3.0, 1.5, -2.0, 3.0}));  // an older record began with its length
}

TEST(ContactStatistics, PacksAndUnpacks)
{
  ContactStatistics statistics;
  ContactStatistics::Pair& counts = statistics.pairs[{PairKey::rigid_wall, 2, 1}];
  counts.taken[Mechanism::plastic] = 0.5;
  counts.speed_max = 3.0;
  counts.speed_min = 0.1;
  counts.speed.add(3.0, 1.0);
  counts.count(7, 3.0, 1.0);
  const std::vector<double> values = statistics.pack();

  ContactStatistics first, other;  // rank 0 takes sums, the others largest and least values alone
  ASSERT_TRUE(first.unpack(values.data(), values.size(), true));
  ASSERT_TRUE(other.unpack(values.data(), values.size(), false));
  const ContactStatistics::Pair &all = first.pairs.at({PairKey::rigid_wall, 2, 1}),
                                &some = other.pairs.at({PairKey::rigid_wall, 2, 1});
  EXPECT_EQ(all.taken[Mechanism::plastic], 0.5);
  EXPECT_EQ(all.overlap.count[7], 1.0);
  EXPECT_EQ(all.map, counts.map);
  EXPECT_EQ(some.taken[Mechanism::plastic], 0.0);
  EXPECT_EQ(some.overlap.count[7], 0.0);
  EXPECT_EQ(some.speed_max, 3.0);
  EXPECT_EQ(some.speed_min, 0.1);
}

TEST(ContactStatistics, AnotherLayoutIsNotTaken)
{
  ContactStatistics statistics;
  statistics.pairs[{}].touches = 1.0;
  const std::vector<double> values{-3.0, 1.0, 2.0};
  EXPECT_FALSE(statistics.unpack(values.data(), values.size(), true));
  EXPECT_FALSE(statistics.unpack(nullptr, 0, true));
  EXPECT_EQ(statistics.pairs[{}].touches, 1.0);
}

TEST(ContactStatistics, ReadNothingBeyondTheirEnd)
{
  ContactStatistics statistics;
  statistics.pairs[{}].count(7, 3.0, 1.0);
  std::vector<double> values = statistics.pack();
  const std::size_t length = values.size() - 3;  // of the map that follows, one bin and its count
  ASSERT_EQ(values[length], 2.0);
  for (const double damaged : {-1.0, 1e18, static_cast<double>(NAN)}) {
    values[length] = damaged;
    ContactStatistics read;
    EXPECT_TRUE(read.unpack(values.data(), values.size(), true));
  }
}

}  // namespace granulaw::plugin::restart_record_test
