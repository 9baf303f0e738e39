#include "word_lists.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>

namespace granulaw {

namespace {

using Words = std::vector<std::string>;

constexpr const char* between = ", \t\n";

bool is_option(const std::string& word)
{
  return word.size() > 1 && word[0] == '-' && std::string("0123456789.").find(word[1]) == std::string::npos;
}

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
