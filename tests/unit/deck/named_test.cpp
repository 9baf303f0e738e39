#include "deck/commands/named.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck {
namespace {

TEST(Named, KnowsWhatWasPutUntilItIsErased)
{
  Named<int> things("thing");
  things.put("one", 1);
  things.put("three", 2);
  things.put("three", 3);
  EXPECT_EQ(things.at("one"), 1);
  EXPECT_EQ(things.at("three"), 3);
  try {
    things.at("thre");
    FAIL();
  } catch (const Unknown& error) {
    EXPECT_STREQ(error.what(), "no thing 'thre' is known (did you mean 'three'?)");
  }
  things.erase("three");
  EXPECT_THROW(things.at("three"), Unknown);
}

}  // namespace
}  // namespace granulaw::deck
