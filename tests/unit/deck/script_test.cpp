#include "deck/script.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "base/error.hpp"
#include "deck_fixture.hpp"

namespace granulaw::deck {
namespace {

class DeckScript : public Deck
{
 protected:
  /// Words of every command that the script hands on, joined.
  std::vector<std::string> commands(const std::string& text, const Presets& presets = {})
  {
    std::vector<std::string> result;
    Script script(
        [&](const Command& c) {
          std::string line;
          for (const auto& word : c.words) line += (line.empty() ? "" : " ") + word;
          result.push_back(c.unknown.empty() ? line : "UNKNOWN");
        },
        [](std::string_view name) { return name == "step" ? std::optional(7.0) : std::nullopt; });
    for (const auto& [name, values] : presets) script.preset(name, values);
    script.read(write("in.deck", text));
    notes_ = script.notes();
    return result;
  }

  std::vector<std::string> notes_;
};

using Lines = std::vector<std::string>;

TEST_F(DeckScript, SubstitutesVariables)
{
  EXPECT_EQ(commands("variable a index 3 4\nvariable bb equal 2*v_a # comment\nvariable s string word\n"
                     "run $a ${bb} $(v_a+step) ${s} &\n  more\nprint \"${bb} # kept\""),
            (Lines{"run 3 6 10 word more", "print ${bb} # kept"}));
  EXPECT_EQ(commands("variable a index 3\nrun $a", {{"a", {"9"}}}), Lines{"run 9"});
  EXPECT_EQ(commands("run ${nothing}"), Lines{"UNKNOWN"});
}

TEST_F(DeckScript, FollowsLoopsJumpsAndConditions)
{
  EXPECT_EQ(commands("variable k loop 3\nlabel again\nrun $k\nnext k\njump SELF again\nrun 0"),
            (Lines{"run 1", "run 2", "run 3", "run 0"}));
  EXPECT_EQ(commands("variable m index mpm\nif \"${m} == mpm\" then \"run 1\" \"run 2\" else \"run 3\"\n"
                     "if \"1 > 2\" then \"run 4\" elif \"2 > 1\" \"run 5\" else \"run 6\""),
            (Lines{"run 1", "run 2", "run 5"}));
  EXPECT_EQ(commands("jump SELF end\nrun 1\nlabel end\nrun 2"), Lines{"run 2"});
  EXPECT_TRUE(commands("if \"c_ke < 1\" then \"run 1\"").empty());
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_NE(notes_[0].find("in.deck:1"), std::string::npos);
  write("part", "run 2\n");
  EXPECT_EQ(commands("run 1\ninclude part\nrun 3"), (Lines{"run 1", "run 2", "run 3"}));
}

TEST_F(DeckScript, EndsWhereADeckDoesNot)
{
  commands("label a\njump SELF a");
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_THROW(commands("include in.deck"), Error);
  EXPECT_THROW(commands("jump SELF nowhere"), Error);
  EXPECT_THROW(commands("jump missing"), Error);
}

}  // namespace
}  // namespace granulaw::deck
