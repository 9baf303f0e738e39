#include "law/plan_notes.hpp"

#include <gtest/gtest.h>

namespace granulaw::plan_notes_test {

Law made_by(const std::string& command, const std::string& depth = "0.05")
{
  Law law;
  law.pairs = {{"a", "b"}};
  law.provenance = {{command_note, command}, {depth_note, depth}, {deck_note, "in.mill"}};
  return law;
}

TEST(PlanNotes, ThePlannedValueIsNamedInEitherOrder)
{
  Law law = made_by("");
  EXPECT_EQ(planned_text(law, "a", "b", 1), "");
  note_planned(law, "b", "a", 0.0252, 3.33);
  note_planned(law, "a", "b", 0.01, 9);
  EXPECT_EQ(planned_text(law, "a", "b", 1), "planned for in.mill: d/R* 0.0252 at 3.33 m/s");
  EXPECT_EQ(planned_text(law, "b", "a", 10), "planned for in.mill: d/R* 0.252 at 3.33 m/s");
}

TEST(PlanNotes, TheLineMakesALawThatHolds)
{
  const auto line = [](const std::string& command, double overlap) { return remedy_beyond(made_by(command), "a", "b", overlap, 0.05, 0.05); };
  EXPECT_EQ(line("mpm table m.toml --deck in.mill -o law.h5", 0.06), "build a deeper law by 'mpm table m.toml --deck in.mill -o law.h5 --depth 0.2'");
  EXPECT_EQ(line("/usr/bin/mpm table m.toml --depth 0.05 -o law.h5", 0.25), "build a deeper law by 'mpm table m.toml -o law.h5 --depth 0.3'");
  EXPECT_EQ(line("mpm convert in.mill", 0.45), "build a deeper law by 'mpm table MATERIALS.toml --pair a:b -o law.h5 --depth 0.5'");
  EXPECT_NE(line("mpm table m.toml", 0.51).find("no law goes beyond 0.5"), std::string::npos);
  // what was planned may come yet; overlaps of a like pair are four times its table's
  Law law = made_by("mpm table m.toml --deck in.mill --depth 0.05 -o law.h5");
  note_planned(law, "a", "b", 1.0, 3.33);
  EXPECT_EQ(remedy_beyond(law, "b", "a", 0.22, 0.2, 0.05), "build a deeper law by 'mpm table m.toml --deck in.mill -o law.h5 --depth 0.3'");
  // a law that ends before the depth that was asked for
  EXPECT_NE(remedy_beyond(made_by("mpm table m.toml", "0.5"), "a", "b", 0.41, 0.39, 0.39).find("no law of this pair goes deeper"), std::string::npos);
}

}  // namespace granulaw::plan_notes_test
