#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace granulaw {

/// Condition on the word behind an option.
struct Check
{
  std::string allowed;                            ///< in words, for --help and for the complaint
  std::function<bool(const std::string&)> holds;  ///< of one word

  /// "cannot be used: found '2', allowed is ..."; empty: the word is good.
  std::string complaint(const std::string& word) const;
};

/// One option of a command.
class Option
{
 public:
  explicit Option(CLI::Option* option = nullptr) : option_(option) {}
  explicit operator bool() const { return option_ != nullptr; }

  Option& required();
  Option& needs(const Option& other);
  Option& excludes(const Option& other);
  Option& check(const Check& check);
  Option& among(const std::vector<std::string>& words);
  Option& expected(int least, int most);
  Option& expected(int words) { return expected(words, words); }
  Option& pairs_of_words();  ///< two words at a time, several times
  Option& list();            ///< its values are divided by blanks or commas (split_lists)
  Option& description(const std::string& text);
  /// --help shows the value as it is now.
  Option& capture_default_str();

 private:
  CLI::Option* option_;
};

/// The options of a command. CLI11's templates are kept out of the commands: options.cpp alone compiles them.
class Options
{
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  /// `value`: a number, a text, a vector of these, or an optional one; options.cpp has the list.
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& description = {});
  Option add_flag(const std::string& names, bool& value, const std::string& description);
  /// One that was added.
  Option get_option(const std::string& name) const;
  /// Options that were added from the `first` on.
  std::vector<Option> from(std::size_t first) const;
  std::size_t size() const;
  /// Number of times that the option stands on the command line.
  std::size_t count(const std::string& name) const;
  /// Carries the command out, once its options are read.
  void callback(const std::function<void()>& carry_out);

 private:
  CLI::App* app_;
};

// Lists on the command line: "a,b", "a, b" and "a b" behind an option that is one (Option::list) are the same.
/// Each item of a list becomes a word.
std::vector<std::string> split_lists(const CLI::App& command, const std::vector<std::string>& words);

/// With the file that a list has taken before its command, whose own it is: `--materials a,b in.deck`. Empty: no list
/// ends with a file.
std::vector<std::string> give_file_back(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace granulaw
