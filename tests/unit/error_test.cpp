#include "base/error.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "refusal.hpp"

namespace granulaw::error_test {

TEST(Error, NothingPrintableCommandsATerminal)
{
  EXPECT_EQ(printable("\x1b[2J\n\r\t\x01\x7f ok"), "?[2J????? ok");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m, \x9b"
                      "31m"),
            "??31m, ?31m");  // CSI as one character, UTF-8 and Latin-1
  EXPECT_EQ(printable("5 µm, Güte 0.9 √2 ✓"), "5 µm, Güte 0.9 √2 ✓");
  EXPECT_EQ(printable(""), "");
}

TEST(Error, LongTextsAreCutBetweenCharacters)
{
  EXPECT_EQ(cut("short"), "short");
  EXPECT_EQ(cut("0123456789", 4), "0123...");
  EXPECT_EQ(cut("ab\xc3\xa9z", 3), "ab...");  // not inside the two bytes of an e with its accent
}

TEST(Error, AListOfManyWordsNamesTheFirstTwenty)
{
  EXPECT_EQ(list_of({}), "");
  const std::vector<std::string> two{"a", "b"};
  EXPECT_EQ(list_of(two), "a, b");
  std::vector<std::string> many;
  for (int k = 0; k < 21; ++k) many.push_back(std::to_string(k));
  const std::string list = list_of(many);
  EXPECT_TRUE(list.ends_with("18, 19, ... (21 in all)")) << list;
}

TEST(Error, AnUnknownWordIsNamedWithTheNearestKnownOne)
{
  const std::vector<std::string> known{"powder", "glass"};
  const auto sentence = [&](const std::string& word, const std::string& more) {
    return sentence_of([&] { fail_unknown("m.toml", "no material", word, known, more); });
  };
  EXPECT_EQ(sentence("powdr", ""),
            "m.toml: no material 'powdr' (did you mean 'powder'?): allowed is powder, glass");
  EXPECT_EQ(sentence("xyz", ", or a number"),
            "m.toml: no material 'xyz': allowed is powder, glass, or a number");
  EXPECT_EQ(nearest("young_modulus", std::vector<std::string>{"density", "youngs_modulus"}), "youngs_modulus");
}

}  // namespace granulaw::error_test
