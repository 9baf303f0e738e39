#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

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

}  // namespace granulaw::deck
