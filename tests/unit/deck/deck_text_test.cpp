#include "deck/convert/deck_text.hpp"

#include <gtest/gtest.h>

namespace granulaw::deck::deck_text_test {

std::vector<std::string> words_in(const std::string& text)
{
  std::vector<std::string> words;
  for (const Word& w : parse_line(text).words) words.push_back(w.text);
  return words;
}

using Words = std::vector<std::string>;

TEST(DeckText, HasTheWordsOfLiggghts)
{
  EXPECT_EQ(words_in("\trun\t 100 \r"), (Words{"run", "100"}));
  EXPECT_EQ(words_in("run 100# a note"), (Words{"run", "100"}));
  EXPECT_EQ(words_in("print \"a # b\" file 'c d'"), (Words{"print", "\"a # b\"", "file", "'c d'"}));
  EXPECT_EQ(words_in("variable a string it's # x' y"), (Words{"variable", "a", "string", "it's", "#", "x'", "y"}));  // a quote within a word hides the '#' alone
  EXPECT_EQ(words_in("run $((v_a + 1) * 2) every ${b}"), (Words{"run", "$((v_a + 1) * 2)", "every", "${b}"}));
  EXPECT_EQ(words_in("variable a equal (1 + 2)"), (Words{"variable", "a", "equal", "(1", "+", "2)"}));
  EXPECT_EQ(words_in("  # all of it"), Words{});
}

TEST(DeckText, KeepsWhatItReads)
{
  for (const std::string line : {"fix  a all nve # x", "", "# only", "print \"a  b\"  ", "\tif \"$a > 1\" then 'run 2'"}) EXPECT_EQ(parse_line(line).text(), line);
}

TEST(DeckText, CountsTheLinesOfTheFile)
{
  const DeckText text("in.deck", "# a\r\nfix a &\r\n  all \v&\n nve\n# goes on &\nrun 1\n\nrun 2");
  std::vector<std::pair<int, int>> places;
  for (const DeckLine& line : text.lines()) places.emplace_back(line.first, line.last);
  EXPECT_EQ(places, (std::vector<std::pair<int, int>>{{1, 1}, {2, 4}, {5, 6}, {7, 7}, {8, 8}}));
  EXPECT_EQ(text.text(), "# a\nfix a   all \v nve\n# goes on run 1\n\nrun 2\n");
}

}  // namespace granulaw::deck::deck_text_test
