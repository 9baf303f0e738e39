#include "deck/commands/runs.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

using DeckRuns = Deck;

TEST_F(DeckRuns, CountTheirStepsAndTheParticlesInThem)
{
  const Scene s = scene(falling("run 300 every 10 'print x'\nrun 500 upto\nrun 400 upto"));
  ASSERT_EQ(s.runs.size(), 3u);
  EXPECT_EQ(s.runs[0].steps, 300);
  EXPECT_EQ(s.runs[0].particles, 50);  // the mean of none before it and 100 after it
  EXPECT_EQ(s.runs[1].steps, 200);
  EXPECT_EQ(s.runs[2].steps, 1000);
  EXPECT_EQ(s.runs[2].time_step, 1e-5);
  EXPECT_TRUE(holds(s.notes, {"run ... every"}));
  EXPECT_TRUE(holds(s.notes, {"it would run backwards"}));
  EXPECT_TRUE(holds(scene("units si\nrun 1").notes, {"in.deck:2", "no time step"}));
}

}  // namespace
}  // namespace granulaw::deck
