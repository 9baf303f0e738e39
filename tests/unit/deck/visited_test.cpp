#include "deck/visited.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck::visited_test {

using DeckVisited = Deck;

TEST_F(DeckVisited, KeepsWhatARunVisitedByTypes)
{
  const auto entry = [](const std::string& kind, int a, int b, double speed, double overlap,
                        double damage_number) {
    return "{\"kind\": \"" + kind + "\", \"types\": [" + std::to_string(a) + ", " + std::to_string(b) +
           "], \"contacts_begun\": 2, \"impact_speed_max_m_per_s\": " + std::to_string(speed) +
           ", \"overlap_over_radius_max\": " + std::to_string(overlap) +
           ", \"damage_number_max\": " + std::to_string(damage_number) + "}";
  };
  const Visited v =
      read_visited(write("s.json", "{\"pairs\": [" + entry("particles", 1, 2, 0.5, 0.25, 0.125) + ", " +
                                       entry("particles", 3, 2, 1.5, 0.75, 0.375) + ", " +
                                       entry("rigid wall", 2, 1, 4, 0.5, 0.0625) + ", " +
                                       entry("deformable wall", 2, 1, 2, 0.625, 0.03125) + "]}"));
  ASSERT_EQ(v.pairs.size(), 2u);
  ASSERT_EQ(v.walls.size(), 1u);
  const auto expect = [](const Visited::Range& r, double speed, double overlap, double damage_number) {
    EXPECT_EQ(r.speed, speed);
    EXPECT_EQ(r.overlap, overlap);
    EXPECT_EQ(r.damage_number, damage_number);
    EXPECT_TRUE(r.met);
  };
  expect(v.pairs.at({1, 2}), 0.5, 0.25, 0.125);
  expect(v.pairs.at({2, 3}), 1.5, 0.75, 0.375);
  expect(v.walls.at({2, 1}), 4, 0.625, 0.0625);  // both walls of a type are one meeting: the larger of each
}

}  // namespace granulaw::deck::visited_test
