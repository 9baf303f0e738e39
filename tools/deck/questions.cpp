#include "deck/questions.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace granulaw::deck {

void ask(std::vector<Question>& questions, const std::string& what, const std::string& option)
{
  const bool is_there = std::any_of(questions.begin(), questions.end(),
                                    [&](const Question& q) { return q.what == what && q.option == option; });
  if (!is_there) questions.push_back({what, option});
}

std::string first_of(const std::vector<std::string>& reasons)
{
  return reasons.size() == 1 ? reasons[0] : fmt::format("{} (and {} more)", reasons[0], reasons.size() - 1);
}

}  // namespace granulaw::deck
