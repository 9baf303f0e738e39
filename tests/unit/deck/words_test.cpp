#include "deck/words.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck {
namespace {

Command command(const std::vector<std::string>& words)
{
  return {"in.deck:7", "folder", words, ""};
}

TEST(Words, AreReadInTheirOrder)
{
  const Command c = command({"fix", "1.5", "a", "1", "2", "3", "file", "x"});
  Words w(c);
  EXPECT_EQ(w.name(), "fix");
  EXPECT_EQ(w.where(), "in.deck:7");
  EXPECT_EQ(w.value(), 1.5);
  EXPECT_FALSE(w.take("b"));
  EXPECT_TRUE(w.take("a"));
  EXPECT_EQ(w.vector(), (Vec3{1, 2, 3}));
  EXPECT_EQ(w.peek(), "file");
  EXPECT_EQ(w.behind("file").path(), "folder/x");
  EXPECT_FALSE(w.after("a"));  // it lies behind us
  EXPECT_THROW(w.behind("a"), Unknown);
  EXPECT_EQ(w.word(), "file");
  EXPECT_EQ(w.word(), "x");
  EXPECT_FALSE(w.more());
  EXPECT_THROW(w.word(), Unknown);
  EXPECT_THROW(w.peek(), Unknown);
  EXPECT_FALSE(w.take("x"));
}

TEST(Words, NumbersOfThingsAndTypesStayInTheirRange)
{
  const auto words = [](const Command& c) { return Words(c); };
  for (const char* bad : {"-1", "1e7", "x", "nan"}) {
    const Command c = command({"run", bad});
    EXPECT_THROW(words(c).count(), Unknown) << bad;
    EXPECT_THROW(words(c).atom_type(), Unknown) << bad;
  }
  const Command zero = command({"run", "0"}), two = command({"run", "2"});
  EXPECT_EQ(words(zero).count(), 0u);
  EXPECT_THROW(words(zero).atom_type(), Unknown);
  EXPECT_EQ(words(two).count(), 2u);
  EXPECT_EQ(words(two).atom_type(), 2);
}

}  // namespace
}  // namespace granulaw::deck
