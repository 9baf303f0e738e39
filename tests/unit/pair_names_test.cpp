#include "law/pair_names.hpp"

#include "scratch_folder.hpp"

namespace granulaw::pair_names_test {

Law law_of(const std::vector<PairNames>& pairs)
{
  Law law;
  for (const auto& [a, b] : pairs) law.pairs.push_back({a, b});
  return law;
}

TEST(PairNames, AreSplitAtTheFirstColon)
{
  EXPECT_EQ(split_pair("a:b"), PairNames("a", "b"));
  EXPECT_EQ(split_pair("a"), PairNames("a", ""));
  EXPECT_EQ(split_pair("a:b:c"), PairNames("a", "b:c"));
}

TEST(PairNames, OfALaw)
{
  const Law law = law_of({{"a", "b"}, {"a", "wall"}});
  EXPECT_EQ(pair_option("a:wall", law), PairNames("a", "wall"));
  EXPECT_EQ(pairs_asked("a:b", law), (std::vector<PairNames>{{"a", "b"}}));
  EXPECT_EQ(pairs_asked("", law), (std::vector<PairNames>{{"a", "b"}, {"a", "wall"}}));
  EXPECT_EQ(sentence_of([&] { pair_option("ab", law); }),
            "--pair: cannot be used: found 'ab', allowed is a:b, a:wall");
}

TEST(PairNames, ToMakeALawFor)
{
  EXPECT_EQ(new_pair("wall:a"), PairNames("wall", "a"));
  for (const char* text : {"", "a", "a:", ":a", "wall:wall", "wall"})
    expect_error("--pair: cannot be used: found '" + std::string(text) + "', allowed is a:b or a:wall",
                 [&] { new_pair(text); });
}

}  // namespace granulaw::pair_names_test
