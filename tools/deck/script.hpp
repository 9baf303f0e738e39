#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "deck/expression.hpp"

namespace granulaw::deck {

/// One command of a deck after substitution of its variables.
struct Command
{
  std::string where;               ///< "FILE:LINE" of its first line
  std::string folder;              ///< in which the deck was started: paths in it count from there
  std::vector<std::string> words;  ///< the first is the command's name
  std::string unknown;             ///< why a variable in it could not be substituted; empty: all were
};

/// Reads an input script of LIGGGHTS in the order in which LIGGGHTS would execute it: continuation lines,
/// comments, quotes, `variable` (index, loop, equal, string; of world, universe and uloop the first value),
/// $x, ${name} and $(formula), `if`, `include`, `label`, `jump`, `next`, and hands every other command on.
/// What it cannot follow goes into notes(), with file and line. Throws Error where a file cannot be read.
class Script
{
 public:
  /// `state`: thermo keywords that are known without a run ("step", "dt").
  Script(std::function<void(const Command&)> execute, Lookup state)
      : execute_(std::move(execute)), state_(std::move(state))
  {
  }

  /// As -var NAME VALUE...: an index variable that the deck cannot set again.
  void preset(const std::string& name, const std::vector<std::string>& values);
  void read(const std::string& path);

  const std::vector<std::string>& notes() const { return notes_; }
  void note(const std::string& where, const std::string& what);

  /// Text with its variables substituted; as in LIGGGHTS not within double quotes if `skip_quoted`. Throws
  /// Unknown.
  std::string substitute(const std::string& text, bool skip_quoted) const;
  /// The words of a line; quotes are taken off.
  static std::vector<std::string> split(const std::string& text);

  static constexpr int largest_number_of_jumps = 20000, largest_depth = 20, largest_number_of_lines = 2000000;

 private:
  struct Variable
  {
    bool formula = false;  // equal
    bool per_atom = false;
    std::vector<std::string> values;
    std::size_t at = 0;
  };
  struct Line
  {
    int number;
    std::string text;
  };
  using Lines = std::vector<Line>;
  /// Where a `jump` leads.
  struct Jump
  {
    std::string file, label;
  };

  void run_file(const std::string& path, const std::string& label);
  void run_line(const std::string& text, const std::string& where, const std::string& path);
  void run_if(const std::vector<std::string>& words, const std::string& where, const std::string& path);
  void set_variable(const std::vector<std::string>& words, const std::string& where);
  void advance(const std::vector<std::string>& words, const std::string& where);
  bool holds(const std::string& condition) const;
  std::string value(const std::string& name) const;
  double formula(const std::string& text, int depth) const;
  const Lines& lines(const std::string& path);

  std::function<void(const Command&)> execute_;
  Lookup state_;
  std::map<std::string, Variable> variables_;
  std::map<std::string, Lines> files_;
  std::vector<std::string> notes_;
  std::string folder_;
  bool skip_jump_ = false;
  std::vector<Jump> jump_;  // at most one: the jump to take now
  int jumps_ = 0, depth_ = 0, executed_ = 0;
};

/// `path` as the deck means it: counted from the folder in which the deck lies.
std::string path_from(const std::string& folder, const std::string& path);

}  // namespace granulaw::deck
