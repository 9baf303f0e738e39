#include "liggghts_plugin/books/restart_record.hpp"

#include <gtest/gtest.h>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin::restart_record_test {

RestartRecord some_record()
{
  return {{1.5, -2.0, 3.0}, {{"pair", {40l + HistoryMeaning::energy, 2.5}}, {"walls", {41, 1.0}}}};
}

TEST(RestartRecord, ComesBackAsItWas)
{
  for (const RestartRecord& record :
       {some_record(), RestartRecord{}, RestartRecord{{}, {{"w", {1, 1.0}}}}, RestartRecord{{1.0}, {}}}) {
    const RestartRecord back = RestartRecord::from(record.numbers());
    EXPECT_EQ(back.counts, record.counts);
    EXPECT_EQ(back.meanings, record.meanings);
  }
}

TEST(RestartRecord, OfACutRecordComesWhatIsWhole)
{
  const std::vector<double> whole = some_record().numbers();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const RestartRecord back =
        RestartRecord::from({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    EXPECT_EQ(back.counts.size(), length > 3 ? 3u : 0u) << length;
    const bool whole_stretch = back.meanings.contains("walls") && back.meanings.at("walls").stretch > 0;
    EXPECT_FALSE(whole_stretch) << length;
  }
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

}  // namespace granulaw::plugin::restart_record_test
