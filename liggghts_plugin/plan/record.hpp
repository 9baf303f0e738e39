#pragma once

#include <map>
#include <string>
#include <vector>

#include "liggghts_plugin/plan/scene.hpp"

namespace granulaw::plugin::plan {

using deck::Run;
using deck::Source;
using deck::Wall;

/// The scene as the planner fills it, in the deck's units.
struct Record : deck::Scene
{
  void note(const std::string& text);
  void ask_speed(const std::string& text);
  void add_command(const std::string& where, std::vector<std::string> words);
  void add_file(const std::string& path, bool is_written);
  /// All that a plan uses but the runs: what a run that brings nothing new leaves as it is.
  std::vector<double> fingerprint() const;
  std::string json() const;

 private:
  std::map<std::string, std::vector<std::size_t>> places_;  ///< of commands
};

}  // namespace granulaw::plugin::plan
