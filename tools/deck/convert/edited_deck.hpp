#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/number_in.hpp"
#include "deck/convert/convert.hpp"
#include "deck/convert/deck_text.hpp"

namespace granulaw::deck {

/// A whole number, as LIGGGHTS writes and reads one.
std::optional<double> whole_number_in(const std::string& text);

/// True of `fix ID GROUP STYLE ...`.
bool is_fix(const std::vector<std::string>& words, const std::string& style);

/// LIGGGHTS's words of the commands, by file and line.
class Executed
{
 public:
  explicit Executed(const Scene& scene);
  /// Each with other words; empty: it was not executed.
  const std::vector<const DeckCommand*>& at(const std::string& file, int line) const;
  /// Its place among all; the largest number: it was not executed.
  std::size_t order(const std::string& file, int line) const;

 private:
  std::map<std::pair<std::string, int>, std::vector<const DeckCommand*>> by_place_;
  std::map<std::pair<std::string, int>, std::size_t> order_;
};

/// One command of a deck.
struct At
{
  DeckText* file = nullptr;
  std::size_t index = 0;
  DeckLine& line() const { return file->lines()[index]; }
  std::string where() const;
};

/// The files of a deck, changed command by command.
class EditedDeck
{
 public:
  explicit EditedDeck(const Scene& scene);

  template <class Visit>
  void each_command(Visit&& visit)
  {
    for (DeckText& text : texts_)
      for (std::size_t k = 0; k < text.lines().size(); ++k)
        if (!text.lines()[k].words.empty()) visit(At{&text, k});
  }
  At first_line();

  /// As LIGGGHTS executed it; where it did not, or in a line that holds other commands, as it stands.
  std::vector<std::string> words_of(const At& at) const;
  std::vector<const DeckCommand*> executed(const At& at) const { return executed_.at(at.file->path(), at.line().first); }
  std::size_t order(const At& at) const { return executed_.order(at.file->path(), at.line().first); }

  void note(const At& at, const std::string& before, const std::string& after, const std::string& why);
  /// Notes a thing that is not converted here.
  void leave(const At& at, const std::string& what);
  void replace(const At& at, const std::string& text, const std::string& why);
  void replace_word(const At& at, std::size_t word, const std::string& text, const std::string& why);
  void remove(const At& at, const std::string& why);

  ConvertedDeck result() const;

 private:
  const Scene& scene_;
  Executed executed_;
  std::vector<DeckText> texts_;
  std::vector<Change> changes_;
  std::vector<std::string> left_;
};

/// Words as they stand in the line, without quotes.
std::vector<std::string> raw_words(const DeckLine& line);

}  // namespace granulaw::deck
