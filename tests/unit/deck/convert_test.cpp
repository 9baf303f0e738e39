// Decks that mpm convert changes line by line, without LIGGGHTS: scenes whose commands are the deck's lines (tests/liggghts/test_convert.py: end to end).
#include "deck/convert/convert.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "scratch_folder.hpp"

namespace granulaw::deck::convert_test {

/// `@`: the changed line of a case. The last lines are counts of steps.
constexpr const char* frame =
    "units si\natom_style granular\ncreate_box 1 box\nfix m1 all property/global youngsModulus peratomtype 5e6\n"
    "fix m2 all property/global poissonsRatio peratomtype 0.45\npair_style gran model hertz tangential history\npair_coeff * *\n"
    "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0\n@\ntimestep 2e-5\nfix move all nve/sphere\nrun 1000\n";

class ConvertTest : public ScratchFolder
{
 protected:
  ConvertedDeck converted(const std::string& text, double stretch = 1, double step_factor = 1)
  {
    Scene scene;
    scene.units = "si", scene.types = 1, scene.time_step = 2e-5, scene.deck = "in.deck", scene.folder = path("");
    write("in.deck", text);
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      std::istringstream words(line);
      DeckCommand command{"in.deck", number, {}};
      for (std::string word; words >> word;) command.words.push_back(word);
      if (command.words.empty()) continue;
      if (command.words[0] == "run") scene.runs.push_back({"in.deck:" + std::to_string(number), std::stod(command.words[1]), 2e-5, 50});
      scene.commands.push_back(command);
    }
    Conversion choices;
    choices.materials = {"bead"}, choices.youngs_modulus = {{1, 5e9}}, choices.poisson_ratio = {{1, 0.3}};
    choices.stretch = stretch, choices.step_factor = step_factor;
    return convert(scene, choices);
  }

  static std::string with(const std::string& old, const std::string& line)
  {
    std::string text = frame;
    return text.replace(text.find(old), old.size(), line);
  }
};

TEST_F(ConvertTest, LinesOfADeck)
{
  const std::string own = " law law.h5 materials bead beyondRange crush\n", pair = "pair_style gran model hertz tangential history";
  const std::string wall = "fix floor all wall/gran model hertz tangential history";
  const struct
  {
    std::string old, line, wanted;
  } cases[] = {
      {"@", "thermo 7", "pair_style gran model mpm tangential history" + own},
      {"@", "thermo 7", "\nfix floor all wall/gran model mpm tangential history primitive type 1 zplane 0\n"},
      {"@", "thermo 7", "youngsModulus peratomtype 5000000000\nfix m2 all property/global poissonsRatio peratomtype 0.3\n"},
      {"@", "thermo 7", "hard_particles yes\n"},
      {pair, "pair_style gran model hooke tangential history tangential_damping on viscous off",
       "pair_style gran model mpm tangential history tangential_damping on" + own},
      {pair, "pair_style gran model hooke/hysteresis tangential history", "pair_style gran model mpm tangential history" + own},
      {pair, "pair_style gran model hertz tangential no_history rolling_friction cdt", "model mpm tangential no_history rolling_friction cdt" + own},
      {pair, "pair_style gran model mpm tangential plastic", "pair_style gran model mpm tangential plastic" + own},
      {pair, "pair_style hybrid gran model hertz tangential history lj/cut 1",
       "pair_style hybrid gran model mpm tangential history law law.h5 materials bead beyondRange crush lj/cut 1\n"},
      {wall, "fix floor all wall/gran model hooke tangential history",
       "\nfix floor all wall/gran model mpm tangential history primitive type 1 zplane 0\n"},
      {"fix move all nve/sphere", "fix move all multisphere", " law law.h5 materials bead bodyCompliance on beyondRange crush\n"},
      {"@", "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5", "# fix m3 all property/global coefficientRestitution"},
      {"@", "newton on", "\nnewton off"},
      {"@", "neighbor 0.002 multi", "\nneighbor 0.002 bin"},
      {"@", "run_style respa 2 2", "\nrun_style verlet"},
      {"@", "jump in.deck again", "\njump SELF again"},
      {"@", "log ../results/log.deck", "\nlog results/log.deck"},
      {"fix m1 all property/global youngsModulus peratomtype 5e6\n", "",
       "fix granulaw_youngsModulus all property/global youngsModulus peratomtype 5000000000\npair_style"},
  };
  for (const auto& [old, line, wanted] : cases) {
    const std::string found = converted(with(old, line)).files.at("in.deck");
    EXPECT_NE(found.find(wanted), std::string::npos) << "'" << wanted << "' is not in\n" << found;
  }
}

TEST_F(ConvertTest, AWallBeforeItsPairStyleGoesBehind)
{
  const std::string floor = "fix side all wall/gran model hertz tangential history primitive type 1 xplane 0\n";
  const std::string found = converted(with("create_box 1 box\n", "create_box 1 box\n" + floor)).files.at("in.deck");
  ASSERT_NE(found.find("\nfix side all wall/gran model mpm"), std::string::npos) << found;
  EXPECT_LT(found.find("\npair_style gran model mpm"), found.find("\nfix side all wall/gran model mpm"));
}

TEST_F(ConvertTest, StretchAndStepsAreCarriedIntoTheDeck)
{
  const std::string stretched = converted(with("@", "fix c all property/global cohesionEnergyDensity peratomtypepair 1 3e5"), 2).files.at("in.deck");
  EXPECT_NE(stretched.find("cohesionEnergyDensity peratomtypepair 1 75000\n"), std::string::npos) << stretched;
  EXPECT_NE(stretched.find(" stretch 2 beyondRange crush"), std::string::npos) << stretched;
  for (const auto& [line, wanted] : {std::pair<std::string, std::string>{"thermo 100", "\nthermo 400\n"},
                                     {"dump d all custom 100 d.txt id", "\ndump d all custom 400 d.txt id\n"},
                                     {"fix a all ave/time 5 10 100 c_k", " ave/time 20 10 400 c_k\n"},
                                     {"restart 50 a b", "\nrestart 200 a b\n"},
                                     {"thermo 7", "\nrun 4000\n"}}) {
    const std::string found = converted(with("@", line), 1, 4).files.at("in.deck");
    EXPECT_NE(found.find(wanted), std::string::npos) << "'" << wanted << "' is not in\n" << found;
    EXPECT_NE(found.find("\ntimestep 5e-06\n"), std::string::npos) << found;
  }
}

TEST_F(ConvertTest, WhatIsLeftIsNamed)
{
  const auto left = [&](const std::string& line) {
    const ConvertedDeck deck = converted(with("@", line), 1, 4);
    return deck.left.empty() ? std::string() : deck.left.front();
  };
  EXPECT_EQ(left("thermo 7"), "");
  EXPECT_NE(left("if \"1 > 0\" then \"run 100\"").find("in.deck:9: 'run 100' in a branch"), std::string::npos) << left("if \"1 > 0\" then \"run 100\"");
  EXPECT_NE(left("fix slow all nve/limit absolute 1").find("limits the way in one time step"), std::string::npos);
  EXPECT_NE(sentence_of([&] { converted("units si\npair_style soft 1\nrun 1\n"); }).find("in.deck:2: 'pair_style soft'"), std::string::npos);
}

}  // namespace granulaw::deck::convert_test
