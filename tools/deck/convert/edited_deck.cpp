#include "deck/convert/edited_deck.hpp"

#include <fmt/format.h>

#include <limits>

namespace granulaw::deck {

std::optional<double> whole_number_in(const std::string& text)
{
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos || text.size() > 15) return {};
  return number_in(text);
}

bool is_fix(const std::vector<std::string>& words, const std::string& style) { return words.size() > 3 && words[0] == "fix" && words[3] == style; }

std::vector<std::string> raw_words(const DeckLine& line)
{
  std::vector<std::string> words;
  for (const Word& w : line.words) words.push_back(w.unquoted());
  return words;
}

Executed::Executed(const Scene& scene)
{
  for (std::size_t k = 0; k < scene.commands.size(); ++k) {
    const DeckCommand& c = scene.commands[k];
    by_place_[{c.file, c.line}].push_back(&c);
    order_.try_emplace({c.file, c.line}, k);
  }
}

const std::vector<const DeckCommand*>& Executed::at(const std::string& file, int line) const
{
  static const std::vector<const DeckCommand*> none;
  const auto found = by_place_.find({file, line});
  return found == by_place_.end() ? none : found->second;
}

std::size_t Executed::order(const std::string& file, int line) const
{
  const auto found = order_.find({file, line});
  return found == order_.end() ? std::numeric_limits<std::size_t>::max() : found->second;
}

std::string At::where() const { return fmt::format("{}:{}", file->path(), line().first); }

EditedDeck::EditedDeck(const Scene& scene) : scene_(scene), executed_(scene)
{
  for (const auto& [path, text] : command_files(scene)) texts_.emplace_back(path, text);
}

At EditedDeck::first_line()
{
  for (DeckText& text : texts_)
    if (text.path() == main_file(scene_)) return {&text, 0};
  return {&texts_.front(), 0};
}

std::vector<std::string> EditedDeck::words_of(const At& at) const
{
  std::vector<std::string> raw = raw_words(at.line());
  const auto done = executed(at);
  if (done.empty() || raw[0] == "if" || done[0]->words[0] != raw[0]) return raw;
  return done[0]->words;
}

void EditedDeck::note(const At& at, const std::string& before, const std::string& after, const std::string& why) { changes_.push_back({at.where(), before, after, why}); }

void EditedDeck::leave(const At& at, const std::string& what) { left_.push_back(at.where() + ": " + what); }

void EditedDeck::replace(const At& at, const std::string& text, const std::string& why)
{
  DeckLine& line = at.line();
  const std::string before = line.text();
  DeckLine now = parse_line(text);
  if (!now.words.empty()) now.words[0].blanks = line.words[0].blanks;
  now.comment = line.comment;
  now.first = line.first, now.last = line.last;
  line = now;
  note(at, before, line.text(), why);
}

void EditedDeck::replace_word(const At& at, std::size_t word, const std::string& text, const std::string& why)
{
  const std::string before = at.line().text();
  at.line().words[word].text = text;
  note(at, before, at.line().text(), why);
}

void EditedDeck::remove(const At& at, const std::string& why)
{
  note(at, at.line().text(), "", why);
  at.file->remove(at.index);
}

ConvertedDeck EditedDeck::result() const
{
  ConvertedDeck done;
  for (const DeckText& text : texts_) done.files[text.path()] = text.text();
  done.changes = changes_;
  done.left = left_;
  return done;
}

}  // namespace granulaw::deck
