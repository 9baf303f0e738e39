#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "deck/scene.hpp"

namespace granulaw::deck {

/// A folder of its own for each test.
class Deck : public testing::Test
{
 protected:
  void SetUp() override
  {
    folder_ = std::filesystem::temp_directory_path() /
              ("granulaw_deck_" + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  Scene scene(const std::string& text, const Presets& presets = {}) const
  {
    return read_scene(write("in.deck", text), presets);
  }
  /// Whether one of the lines holds all of these parts.
  static bool holds(const std::vector<std::string>& lines, const std::vector<std::string>& parts)
  {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return std::all_of(parts.begin(), parts.end(),
                         [&](const std::string& part) { return line.find(part) != std::string::npos; });
    });
  }

 private:
  std::filesystem::path folder_;
};

/// Spheres of 2 mm that fall from at most 0.2 m; `more` before the run.
inline std::string falling(const std::string& more,
                           const std::string& insertion = "particles_in_region 100 region bc")
{
  return "units si\nregion reg block -1 1 -1 1 0 1 units box\ncreate_box 2 reg\n"
         "region bc cylinder z 0 0 0.05 0.1 0.2 units box\n"
         "fix m1 all property/global youngsModulus peratomtype 91e6 210e9\n"
         "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\n"
         "fix g all gravity 9.81 vector 0 0 -2\ntimestep 1e-5\n"
         "fix w all wall/gran model hertz primitive type 2 zplane 0.0\n"
         "fix p all particletemplate/sphere 1 atom_type 1 density constant 1000 radius constant 0.002\n"
         "fix d all particledistribution/discrete 1 1 p 1.0\n"
         "fix ins all insert/pack seed 1 distributiontemplate d vel constant 0 0 -0.5 insert_every once " +
         insertion + "\n" + more + "\nrun 1000\n";
}

}  // namespace granulaw::deck
