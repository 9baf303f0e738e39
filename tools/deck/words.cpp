#include "deck/words.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace granulaw::deck {

void misread(const std::string& why)
{
  throw Unknown(why);
}

void misread(const std::string& why, std::string_view word, std::span<const std::string> known)
{
  misread(why + did_you_mean(word, known));
}

const std::string& Words::peek() const
{
  if (!more()) misread("it ends too early");
  return command_->words[at_];
}

const std::string& Words::word()
{
  const std::string& found = peek();
  ++at_;
  return found;
}

double Words::value()
{
  const std::string& found = word();
  const auto value = number(found);
  if (!value) misread(fmt::format("found '{}' where a number should be", found));
  return *value;
}

Vec3 Words::vector()
{
  Vec3 v;
  for (double& component : v) component = value();
  return v;
}

std::size_t Words::count()
{
  const double n = value();
  if (n < 0 || n > 1e6) misread(fmt::format("{:g} is no number of things", n));
  return static_cast<std::size_t>(n);
}

int Words::atom_type()
{
  const double type = value();
  if (type < 1 || type > 1e6) misread(fmt::format("{:g} is no atom type", type));
  return static_cast<int>(type);
}

std::string Words::path()
{
  return path_from(command_->folder, word());
}

bool Words::take(std::string_view keyword)
{
  if (!more() || peek() != keyword) return false;
  ++at_;
  return true;
}

std::optional<Words> Words::after(std::string_view keyword) const
{
  Words rest = *this;
  while (rest.more())
    if (rest.word() == keyword) return rest;
  return {};
}

Words Words::behind(std::string_view keyword) const
{
  const auto rest = after(keyword);
  if (!rest) misread(fmt::format("'{}' is missing", keyword));
  return *rest;
}

}  // namespace granulaw::deck
