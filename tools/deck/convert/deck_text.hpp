#pragma once

#include <string>
#include <vector>

namespace granulaw::deck {

/// A word of a deck's line, with the blanks before it; quotes are part of it.
struct Word
{
  std::string blanks, text;
  std::string unquoted() const;
  bool has_variable() const { return text.find('$') != std::string::npos; }
};

/// One command of a deck, on one line of the file or, with '&', on several.
struct DeckLine
{
  int first = 0, last = 0;  ///< lines of the file, from 1
  std::vector<Word> words;  ///< none: blank, or a comment
  std::string comment;      ///< behind the words, with its blanks
  std::string text() const;
};

/// A file of commands that is edited. Every command keeps its place until text() is called.
class DeckText
{
 public:
  DeckText(std::string path, const std::string& text);

  const std::string& path() const { return path_; }  ///< as the deck calls it
  std::vector<DeckLine>& lines() { return lines_; }
  const std::vector<DeckLine>& lines() const { return lines_; }

  /// The command stands as a comment.
  void remove(std::size_t line) { edits_[line].removed = true; }
  bool is_removed(std::size_t line) const { return edits_[line].removed; }
  /// A line of its own.
  void insert_before(std::size_t line, const std::string& text) { edits_[line].before.push_back(text); }
  void insert_behind(std::size_t line, const std::string& text) { edits_[line].behind.push_back(text); }
  /// The command goes behind another one of this file.
  void move_behind(std::size_t line, std::size_t other);

  std::string text() const;

 private:
  struct Edit
  {
    bool removed = false;
    std::vector<std::string> before, behind;
  };
  std::string path_;
  std::vector<DeckLine> lines_;
  std::vector<Edit> edits_;
};

/// Words of one command.
DeckLine parse_line(const std::string& text);

}  // namespace granulaw::deck
