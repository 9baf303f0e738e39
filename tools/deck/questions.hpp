#pragma once

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
void ask(std::vector<Question>& questions, const std::string& what, const std::string& option);

/// "FIRST (and 3 more)": `reasons` is not empty.
std::string first_of(const std::vector<std::string>& reasons);

}  // namespace granulaw::deck
