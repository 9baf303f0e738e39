#include "deck/convert/deck_variables.hpp"

#include <algorithm>
#include <regex>

namespace granulaw::deck {

bool DeckVariables::follows(const std::string& text, const std::set<std::string>& roots) const
{
  std::set<std::string> seen;
  return follows(text, roots, seen);
}

bool DeckVariables::any_follows(const std::set<std::string>& roots) const
{
  return std::any_of(formulas_.begin(), formulas_.end(),
      [&](const auto& entry) { return std::any_of(entry.second.begin(), entry.second.end(), [&](const std::string& f) { return follows(f, roots); }); });
}

bool DeckVariables::follows(const std::string& text, const std::set<std::string>& roots, std::set<std::string>& seen) const
{
  static const std::regex names(R"(\$\{(\w+)\}|\$(\w)|\bv_(\w+)|\b(dt)\b)");
  for (std::sregex_iterator at(text.begin(), text.end(), names), end; at != end; ++at) {
    if ((*at)[4].matched) return true;
    const std::string name = (*at)[1].str() + (*at)[2].str() + (*at)[3].str();
    if (roots.contains(name)) return true;
    const auto found = formulas_.find(name);
    if (found == formulas_.end() || !seen.insert(name).second) continue;
    if (std::any_of(found->second.begin(), found->second.end(), [&](const std::string& f) { return follows(f, roots, seen); })) return true;
  }
  return false;
}

}  // namespace granulaw::deck
