#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace granulaw::deck {

/// A thing the deck does not give, and the option that does.
struct Question
{
  std::string what, option;
};

/// A number is needed that the deck does not say: mpm ends with exit code 3.
class Unanswered : public Error
{
 public:
  using Error::Error;
};

/// Adds the question, unless it is there.
inline void ask(std::vector<Question>& questions, const std::string& what, const std::string& option)
{
  const bool is_there = std::any_of(questions.begin(), questions.end(), [&](const Question& q) { return q.what == what && q.option == option; });
  if (!is_there) questions.push_back({what, option});
}

/// "FIRST (and 3 more)": `reasons` is not empty.
inline std::string first_of(const std::vector<std::string>& reasons)
{
  return reasons[0] + (reasons.size() > 1 ? " (and " + std::to_string(reasons.size() - 1) + " more)" : "");
}

}  // namespace granulaw::deck
