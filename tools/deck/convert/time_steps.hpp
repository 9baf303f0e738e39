#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deck/convert/edited_deck.hpp"

namespace granulaw::deck {

/// The variables of a deck, by the formulas of their definitions.
class DeckVariables
{
 public:
  void define(const std::string& name, const std::string& formula) { formulas_[name].push_back(formula); }
  /// True if a value in this text comes from one of `roots`, or from LIGGGHTS's own keyword for the time step.
  bool follows(const std::string& text, const std::set<std::string>& roots) const;
  bool any_follows(const std::set<std::string>& roots) const;

 private:
  bool follows(const std::string& text, const std::set<std::string>& roots, std::set<std::string>& seen) const;
  std::map<std::string, std::vector<std::string>> formulas_;
};

/// The time step of a converted deck, and what counts in it.
class TimeSteps
{
 public:
  TimeSteps(EditedDeck& deck, const Scene& scene, const Conversion& conversion);

  /// Every `timestep`, and variables that follow it: one that was a whole number stays one.
  void change_steps();
  /// A variable is computed from the time step.
  bool is_followed() const { return is_changed() && variables_.any_follows(step_variables_); }
  /// Words of a command that are no counts of steps follow the time step: a speed, a size.
  bool more_than_counts_follow() const;
  /// Counts of steps that do not follow the time step by themselves.
  void convert_counts(const At& at, const std::vector<std::string>& words);
  /// True if a command within a branch counts steps, and these do not follow.
  bool is_left_in_branch(const std::vector<std::string>& words) const;
  /// Conditions and formulas that depend on the number of the step.
  void warn_of_step(const At& at);

 private:
  bool is_changed() const { return conversion_.step_factor != 1; }
  bool follows(const std::string& text) const { return variables_.follows(text, step_variables_); }
  void change_step(const At& at);
  bool change_definition(const std::string& name);
  void keep_whole_numbers();
  void keep_whole(const std::string& name);
  double count_now(const At& at, std::size_t k, double old) const;
  double scaled(double count) const;
  double wanted_stride(const At& at, const std::vector<std::string>& words, double old) const;
  std::string new_variable(const At& at, const std::string& formula, const std::string& kind);

  EditedDeck& deck_;
  const Scene& scene_;
  const Conversion& conversion_;
  DeckVariables variables_;
  std::set<std::string> step_variables_;  ///< whose definitions are changed
  int made_ = 0;
};

}  // namespace granulaw::deck
