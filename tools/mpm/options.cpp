#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
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

#define GRANULAW_OPTION(...) template Option Options::add_option(const std::string&, __VA_ARGS__&, const std::string&);
GRANULAW_OPTION(int)
GRANULAW_OPTION(unsigned)
GRANULAW_OPTION(double)
GRANULAW_OPTION(std::string)
GRANULAW_OPTION(std::vector<double>)
GRANULAW_OPTION(std::vector<std::string>)
GRANULAW_OPTION(std::optional<int>)
GRANULAW_OPTION(std::optional<double>)
#undef GRANULAW_OPTION

Option Options::add_flag(const std::string& names, bool& value, const std::string& description) { return Option(app_->add_flag(names, value, description)); }

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

namespace {

using Words = std::vector<std::string>;

constexpr const char* between = ", \t\n";

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-' && std::string("0123456789.").find(word[1]) == std::string::npos; }

/// An option with its words. The first one: words before any option.
struct Given
{
  std::string option;
  bool is_list = false;
  Words words;
};

std::vector<Given> given_by(const CLI::App& command, const Words& words)
{
  std::vector<Given> all(1);
  for (const std::string& word : words) {
    if (!is_option(word)) {
      all.back().words.push_back(word);
      continue;
    }
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const CLI::Option* option = command.get_option_no_throw(name);
    const bool is_list = option && option->get_delimiter() == ',';
    all.push_back({is_list ? name : word, is_list, {}});
    if (is_list && equals != std::string::npos) all.back().words.push_back(word.substr(equals + 1));
  }
  return all;
}

Words items_of(const std::string& word)
{
  Words items;
  for (std::size_t at = word.find_first_not_of(between); at != std::string::npos;) {
    const std::size_t end = std::min(word.size(), word.find_first_of(between, at));
    items.push_back(word.substr(at, end - at));
    at = word.find_first_not_of(between, end);
  }
  return items;
}

}  // namespace

std::vector<std::string> split_lists(const CLI::App& command, const std::vector<std::string>& words)
{
  Words result;
  for (const Given& given : given_by(command, words)) {
    if (!given.option.empty()) result.push_back(given.option);
    for (const std::string& word : given.words) {
      const Words items = given.is_list ? items_of(word) : Words{word};
      result.insert(result.end(), items.begin(), items.end());
    }
  }
  return result;
}

std::vector<std::string> give_file_back(const CLI::App& command, const std::vector<std::string>& words)
{
  std::vector<Given> all = given_by(command, words);
  for (Given& given : all) {
    std::error_code ignored;
    if (!given.is_list || given.words.size() < 2 || !std::filesystem::is_regular_file(given.words.back(), ignored)) continue;
    Words result = all[0].words;
    result.push_back(given.words.back());
    given.words.pop_back();
    for (std::size_t k = 1; k < all.size(); ++k) {
      result.push_back(all[k].option);
      result.insert(result.end(), all[k].words.begin(), all[k].words.end());
    }
    return result;
  }
  return {};
}

}  // namespace granulaw
