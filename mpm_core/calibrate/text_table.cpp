#include "calibrate/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr const char* blanks = " \t\r";

std::string trimmed(const std::string& word)
{
  const auto first = word.find_first_not_of(blanks);
  return first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(blanks) - first + 1);
}

/// Lines without their ends.
std::vector<std::string> lines_of(const std::string& text)
{
  std::vector<std::string> lines(1);
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\n' && text[k] != '\r') {
      lines.back() += text[k];
    } else {
      if (text[k] == '\r' && k + 1 < text.size() && text[k + 1] == '\n') ++k;
      lines.emplace_back();
    }
  }
  return lines;
}

/// The first of these that stands outside quotes.
char separator_of(const std::string& line)
{
  for (const char separator : {';', '\t', ','}) {
    bool quoted = false;
    for (const char c : line) {
      quoted ^= c == '"';
      if (c == separator && !quoted) return separator;
    }
  }
  return ' ';
}

std::vector<std::string> words_of(const std::string& line, char separator, const std::string& where)
{
  std::vector<std::string> words(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"')
      words.back() += line[++k];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == separator || (separator == ' ' && c == '\t')))
      words.emplace_back();
    else
      words.back() += c;
  }
  if (quoted) fail(where, "a quote is not closed");
  for (std::string& word : words) word = trimmed(word);
  if (separator == ' ') std::erase(words, "");  // several blanks are one
  while (!words.empty() && words.back().empty()) words.pop_back();
  return words;
}

}  // namespace

std::vector<TextRow> parse_table(const std::string& text, const std::string& source)
{
  if (text.find('\0') != std::string::npos)
    fail(source, "is no text of one byte a character, as 'Unicode text' of a spreadsheet has two", {},
         "CSV in UTF-8");
  const std::string mark = "\xef\xbb\xbf";
  std::vector<TextRow> rows;
  char separator = 0;
  int count = 0;
  for (const std::string& line : lines_of(text.starts_with(mark) ? text.substr(mark.size()) : text)) {
    ++count;
    const std::string bare = trimmed(line);
    if (bare.empty() || bare.front() == '#') continue;
    if (rows.empty() && bare.size() == 5 && bare.starts_with("sep=")) {
      separator = bare.back();
      continue;
    }
    if (separator == 0) separator = separator_of(bare);
    std::vector<std::string> words =
        words_of(separator == '\t' ? line : bare, separator, fmt::format("{}:{}", source, count));
    if (!words.empty() && !words.front().starts_with('#')) rows.push_back({count, std::move(words)});
  }
  return rows;
}

bool is_number(const std::string& word)
{
  char* end = nullptr;
  std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0';
}

namespace {

/// The word with a point for its only comma; empty: that is no number.
std::string with_point(const std::string& word)
{
  if (std::count(word.begin(), word.end(), ',') != 1 || word.find('.') != std::string::npos) return {};
  std::string pointed = word;
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  return is_number(pointed) ? pointed : std::string();
}

/// "1,234" may be 1234, "0,123" and "1,23" are not.
bool may_be_thousands(const std::string& word)
{
  const std::string digits = word.substr(word.find_first_not_of("+-"));
  return digits.front() != '0' && digits.find(',') >= 1 && digits.find(',') <= 3 &&
         digits.size() == digits.find(',') + 4 &&
         digits.find_first_not_of("0123456789,") == std::string::npos;
}

}  // namespace

void point_decimals(std::vector<TextRow>& rows, std::size_t first, const std::string& source)
{
  struct Seen
  {
    int line = 0;
    std::string word{};
    void note(const TextRow& row, const std::string& of)
    {
      if (line == 0) line = row.line, word = of;
    }
  } comma, certain, point;
  for (std::size_t k = first; k < rows.size(); ++k)
    for (const std::string& word : rows[k].words) {
      if (word.find('.') != std::string::npos && is_number(word)) point.note(rows[k], word);
      if (with_point(word).empty()) continue;
      comma.note(rows[k], word);
      if (!may_be_thousands(word)) certain.note(rows[k], word);
    }
  if (comma.line == 0) return;
  const auto refuse = [&](const std::string& why) {
    fail(fmt::format("{}:{}", source, comma.line), why, fmt::format("'{}'", cut(comma.word)),
         "decimal points in all rows, or decimal commas");
  };
  if (point.line != 0)
    refuse(fmt::format("a number has a comma, that of line {} a point ('{}')", point.line, cut(point.word)));
  if (certain.line == 0) refuse("the comma may be a decimal one, or separate thousands");
  for (std::size_t k = first; k < rows.size(); ++k)
    for (std::string& word : rows[k].words)
      if (std::string pointed = with_point(word); !pointed.empty()) word = std::move(pointed);
}

}  // namespace granulaw
