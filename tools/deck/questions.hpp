#pragma once

#include <string>
#include <vector>

namespace granulaw::deck {

/// A thing the deck does not give, and the option that does.
struct Question
{
  std::string what, option;
};

/// Adds the question, unless it is there.
void ask(std::vector<Question>& questions, const std::string& what, const std::string& option);

/// "FIRST (and 3 more)": `reasons` is not empty.
std::string first_of(const std::vector<std::string>& reasons);

}  // namespace granulaw::deck
