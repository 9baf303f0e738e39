#include "option_checks.hpp"

#include "scratch_folder.hpp"

namespace granulaw::option_checks_test {

std::string said(const Check& check, const std::string& word) { return check.complaint(word); }

TEST(OptionChecks, ReadWholeWordsAsNumbers)
{
  EXPECT_EQ(number_in("1e-3"), 1e-3);
  EXPECT_EQ(number_in("+2"), 2);
  EXPECT_EQ(number_in("inf"), std::numeric_limits<double>::infinity());
  for (const char* word : {"", "+", "+-1", "1x", " 1", "x", "20 %"}) EXPECT_FALSE(number_in(word)) << word;
}

TEST(OptionChecks, AcceptTheirRangeOnly)
{
  const struct
  {
    Check check;
    std::vector<std::string> good, bad;
  } cases[] = {
      {from_to(0, 0.5), {"0", "0.5", "1e-9"}, {"-1e-9", "0.51", "nan", "inf", "x"}},
      {whole_from_to(1, 3), {"1", "3", "2.0"}, {"0", "4", "1.5", "nan"}},
      {above_zero_to(0.5), {"0.5", "1e-300"}, {"0", "-1", "0.6", "nan"}},
      {above_zero(), {"1e300"}, {"0", "inf", "nan"}},
  };
  for (const auto& c : cases) {
    for (const std::string& word : c.good) EXPECT_EQ(said(c.check, word), "") << word;
    for (const std::string& word : c.bad) EXPECT_NE(said(c.check, word), "") << word;
  }
  EXPECT_EQ(said(from_to(0, 0.5), "2"), "cannot be used: found '2', allowed is a number from 0 to 0.5");
}

TEST(OptionChecks, RequireSaysWhatIsAllowed)
{
  EXPECT_EQ(sentence_of([] { require(true, "--x", "1", "2"); }), "");
  EXPECT_EQ(sentence_of([] { require(false, "--x", "1", "2"); }),
            "--x: cannot be used: found 1, allowed is 2");
  EXPECT_EQ(sentence_of([] { require_within("--radius", 1e4, "m", 1e-9, 1e3); }),
            "--radius: cannot be used: found 10000 m, allowed is 1e-09 to 1000 m");
  expect_error("found nan m", [] { require_within("--radius", std::nan(""), "m", 1e-9, 1e3); });
}

}  // namespace granulaw::option_checks_test
