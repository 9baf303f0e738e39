#include "deck/convert/deck_text.hpp"

#include <cctype>

namespace granulaw::deck {

namespace {

bool is_blank(char c)
{
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

std::vector<std::string> lines_of(const std::string& text)
{
  std::vector<std::string> lines;
  std::string line;
  for (const char c : text) {
    if (c != '\n') {
      if (c != '\r') line += c;
      continue;
    }
    lines.push_back(line);
    line.clear();
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

/// Position of the '&' that continues the line; npos: it ends here.
std::size_t continuation(const std::string& line)
{
  const auto last = line.find_last_not_of(" \t");
  return last != std::string::npos && line[last] == '&' ? last : std::string::npos;
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
  std::size_t at = 0;
  while (at < text.size()) {
    Word word;
    while (at < text.size() && is_blank(text[at])) word.blanks += text[at++];
    if (at == text.size() || text[at] == '#') {
      line.comment = word.blanks + text.substr(at);
      break;
    }
    char quote = 0;  // a quote begins anywhere in a word, as in print "a"
    for (; at < text.size(); ++at) {
      const char c = text[at];
      if (quote ? c == quote : (c == '"' || c == '\'')) quote = quote ? 0 : c;
      if (!quote && (is_blank(c) || c == '#')) break;
      word.text += c;
    }
    line.words.push_back(word);
  }
  return line;
}

DeckText::DeckText(std::string path, const std::string& text) : path_(std::move(path))
{
  const std::vector<std::string> lines = lines_of(text);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const int first = static_cast<int>(k) + 1;
    std::string joined = lines[k];
    for (auto end = continuation(joined); end != std::string::npos && k + 1 < lines.size();
         end = continuation(joined))
      joined = joined.substr(0, end) + lines[++k];
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
