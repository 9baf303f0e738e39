#include "deck/convert/deck_text.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace granulaw::deck {

namespace {

// LIGGGHTS's own reading (Input::file, parse, nextword).
constexpr const char* blanks = " \t\n\v\f\r";

std::vector<std::string> lines_of(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with('\r')) line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

/// Position of the '&' that continues the line; npos: it ends here.
std::size_t continuation(const std::string& line)
{
  const auto last = line.find_last_not_of(blanks);
  return last != std::string::npos && line[last] == '&' ? last : std::string::npos;
}

/// Position of the '#' that begins the comment: not one within quotes.
std::size_t comment_in(const std::string& text)
{
  char quote = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '#' && !quote) return k;
    if (c == quote)
      quote = 0;
    else if (c == '"' || c == '\'')
      quote = c;
  }
  return text.size();
}

/// Position behind the word that begins at `first`. A formula, "$(a + b)", becomes a number before words are divided.
std::size_t end_of_word(const std::string& text, std::size_t first, std::size_t end)
{
  const char c = text[first];
  if (const auto quote = text.find(c, first + 1); (c == '"' || c == '\'') && quote != std::string::npos) return std::min(end, quote + 1);
  int open = 0;
  for (std::size_t k = first; k < end; ++k) {
    const bool begins = text[k] == '(' && (open > 0 || (k > first && text[k - 1] == '$'));
    open += begins ? 1 : text[k] == ')' && open > 0 ? -1 : 0;
    if (open == 0 && std::string_view(blanks).find(text[k]) != std::string_view::npos) return k;
  }
  return end;
}

}  // namespace

std::string Word::unquoted() const
{
  const bool quoted = text.size() >= 2 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0];
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::string DeckLine::text() const
{
  std::string all;
  for (const Word& w : words) all += w.blanks + w.text;
  return all + comment;
}

DeckLine parse_line(const std::string& text)
{
  DeckLine line;
  const std::size_t end = comment_in(text);
  for (std::size_t at = 0;;) {
    const std::size_t first = std::min(end, text.find_first_not_of(blanks, at));
    if (first == end) {
      line.comment = text.substr(at);
      return line;
    }
    const std::size_t last = end_of_word(text, first, end);
    line.words.push_back({text.substr(at, first - at), text.substr(first, last - first)});
    at = last;
  }
}

DeckText::DeckText(std::string path, const std::string& text) : path_(std::move(path))
{
  const std::vector<std::string> lines = lines_of(text);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const int first = static_cast<int>(k) + 1;
    std::string joined = lines[k];
    for (auto end = continuation(joined); end != std::string::npos && k + 1 < lines.size(); end = continuation(joined)) joined = joined.substr(0, end) + lines[++k];
    DeckLine line = parse_line(joined);
    line.first = first;
    line.last = static_cast<int>(k) + 1;
    lines_.push_back(std::move(line));
  }
  edits_.resize(lines_.size());
}

void DeckText::move_behind(std::size_t line, std::size_t other)
{
  edits_[other].behind.push_back(lines_[line].text());
  remove(line);
}

std::string DeckText::text() const
{
  std::string all;
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    for (const std::string& text : edits_[k].before) all += text + "\n";
    all += (edits_[k].removed ? "# " : "") + lines_[k].text() + "\n";
    for (const std::string& text : edits_[k].behind) all += text + "\n";
  }
  return all;
}

}  // namespace granulaw::deck
