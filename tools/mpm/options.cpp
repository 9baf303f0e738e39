#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>

namespace granulaw {

std::string Check::complaint(const std::string& word) const
{
  if (holds(word)) return {};
  return fmt::format("cannot be used: found '{}', allowed is {}", word, allowed);
}

Option& Option::required()
{
  option_->required();
  return *this;
}

Option& Option::needs(const Option& other)
{
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other)
{
  option_->excludes(other.option_);
  return *this;
}

Option& Option::check(const Check& check)
{
  option_->check(CLI::Validator([check](std::string& word) { return check.complaint(word); }, check.allowed));
  return *this;
}

Option& Option::among(const std::vector<std::string>& words)
{
  option_->check(CLI::IsMember(words));
  return *this;
}

Option& Option::expected(int least, int most)
{
  option_->expected(least, most);
  return *this;
}

Option& Option::pairs_of_words()
{
  option_->type_size(2)->expected(1, 1000);
  return *this;
}

Option& Option::list()
{
  option_->delimiter(',');
  return *this;
}

Option& Option::description(const std::string& text)
{
  option_->description(text);
  return *this;
}

Option& Option::capture_default_str()
{
  option_->capture_default_str();
  return *this;
}

template <class Value>
Option Options::add_option(const std::string& names, Value& value, const std::string& description)
{
  return Option(app_->add_option(names, value, description));
}

#define GRANULAW_OPTION(...) \
  template Option Options::add_option(const std::string&, __VA_ARGS__&, const std::string&);
GRANULAW_OPTION(int)
GRANULAW_OPTION(unsigned)
GRANULAW_OPTION(double)
GRANULAW_OPTION(std::string)
GRANULAW_OPTION(std::vector<double>)
GRANULAW_OPTION(std::vector<std::string>)
GRANULAW_OPTION(std::optional<int>)
GRANULAW_OPTION(std::optional<double>)
#undef GRANULAW_OPTION

Option Options::add_flag(const std::string& names, bool& value, const std::string& description)
{
  return Option(app_->add_flag(names, value, description));
}

Option Options::get_option(const std::string& name) const { return Option(app_->get_option(name)); }

std::vector<Option> Options::from(std::size_t first) const
{
  const auto all = app_->get_options();
  std::vector<Option> found;
  for (std::size_t k = first; k < all.size(); ++k) found.emplace_back(all[k]);
  return found;
}

std::size_t Options::size() const { return app_->get_options().size(); }

std::size_t Options::count(const std::string& name) const { return app_->count(name); }

void Options::callback(const std::function<void()>& carry_out) { app_->callback(carry_out); }

}  // namespace granulaw
