#include "deck/commands/pair_style.hpp"

#include <gtest/gtest.h>

#include "deck_fixture.hpp"
#include "liggghts_plugin/deck_keywords.hpp"

namespace granulaw::deck {
namespace {

using DeckPairStyle = Deck;

/// Names of materials end at each keyword of the plug-in, and what follows it is read.
TEST_F(DeckPairStyle, UnderstandsEveryKeywordOfThePlugin)
{
  for (const plugin::Keyword& k : plugin::keyword_table) {
    if (!k.in_pair_style || k.name == "law" || k.name == "materials" || k.name == "stretch") continue;
    const std::string other = std::string(k.name) + " on ";
    for (const std::string& words : {"law x.h5 materials wax steel " + other + "stretch 2",
                                     other + "stretch 2 law x.h5 materials wax steel",
                                     "stretch 2 materials wax steel " + other + "law x.h5"}) {
      const Scene s = scene("units si\npair_style gran model mpm tangential history " + words);
      EXPECT_EQ(s.material_names, (std::vector<std::string>{"wax", "steel"})) << words;
      EXPECT_EQ(s.stretch, 2) << words;
      EXPECT_TRUE(s.law_file.ends_with("/x.h5")) << words;
      EXPECT_EQ(s.model, "mpm") << words;
      EXPECT_TRUE(s.notes.empty()) << words;
    }
  }
}

TEST_F(DeckPairStyle, AMaterialMayBearTheNameOfAWallsKeyword)
{
  const Scene s = scene("units si\npair_style gran model mpm law x.h5 materials wax wall");
  EXPECT_EQ(s.material_names, (std::vector<std::string>{"wax", "wall"}));
}

TEST_F(DeckPairStyle, MayEndAnywhere)
{
  const std::string line =
      "pair_style gran model mpm tangential history law x.h5 materials wax stretch 2 stats s.json";
  for (std::size_t n = 1; n < line.size(); ++n) EXPECT_NO_THROW(scene("units si\n" + line.substr(0, n))) << n;
}

}  // namespace
}  // namespace granulaw::deck
