#include "calibrate/measurement_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

constexpr std::size_t most_rows = 20000;

std::string known_headers()
{
  std::string all;
  for (const std::string& header : measurement_headers()) all += header + "; ";
  return all + "each with NAME_sd of the last column, if known";
}

std::string trimmed(std::string_view word)
{
  const char* blank = " \t\r\xef\xbb\xbf";  // with a byte order mark
  const auto first = word.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return std::string(word.substr(first, word.find_last_not_of(blank) - first + 1));
}

std::vector<std::string> columns_of(const std::string& line)
{
  std::vector<std::string> words;
  std::stringstream rest(line);
  for (std::string word; std::getline(rest, word, ',');) words.push_back(trimmed(word));
  if (!line.empty() && line.back() == ',') words.emplace_back();
  return words;
}

/// Fails where a column of the header is a known quantity without its unit.
void complain_of_units(const std::vector<std::string>& columns, const std::string& where)
{
  for (const std::string& column : columns)
    for (const Kind* kind : kinds())
      for (const Column& known : {kind->x, kind->y}) {
        const std::string quantity = known.quantity;
        if (*known.unit && known.name() != column && !column.ends_with("_sd") &&
            column.starts_with(quantity) &&
            (column == quantity || std::string("_ [").find(column[quantity.size()]) != std::string::npos))
          fail(where, "a column must name its unit, SI", fmt::format("'{}'", cut(column)),
               fmt::format("'{}'", known.name()));
      }
}

/// The columns of a header.
struct Columns
{
  const Kind* kind;
  bool sd;
  std::size_t count() const { return (kind->x.exists() ? 2 : 1) + (sd ? 1 : 0); }
};

Columns read_header(const std::vector<std::string>& words, const std::string& where, const Kind& curves)
{
  const std::string found = fmt::format("{}", fmt::join(words, ","));
  for (const Kind* kind : kinds()) {
    // kinds of the same columns are distinguished by who calls
    const Kind* chosen = kind->header() == curves.header() ? &curves : kind;
    if (found == kind->header()) return {chosen, false};
    for (const std::string& sd : {std::string(kind->y.quantity), kind->y.name()})
      if (found == kind->header() + "," + sd + "_sd") return {chosen, true};
  }
  complain_of_units(words, where);
  fail(where, "the header names no kind of measurement", fmt::format("'{}'", cut(found)), known_headers());
}

double number(const std::string& word, const std::string& where, const std::string& column)
{
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0')
    fail(where, fmt::format("'{}' is no number", column), fmt::format("'{}'", cut(word)), "a number");
  if (!std::isfinite(value))
    fail(where, fmt::format("'{}' is not finite", column), cut(word), "a finite number");
  return value;
}

void check(const Column& column, double value, const std::string& where)
{
  if (column.exists() && !(value > column.above))
    fail(where, fmt::format("'{}' is out of range", column.name()), fmt::format("{:g}", value),
         column.allowed);
}

}  // namespace

std::vector<std::string> measurement_headers()
{
  std::vector<std::string> all;
  for (const Kind* kind : kinds())
    if (all.empty() || all.back() != kind->header()) all.push_back(kind->header());
  return all;
}

Measurement parse_measurement(const std::string& text, const std::string& source, const Kind& curves)
{
  Measurement m;
  m.source = source;
  std::stringstream lines(text);
  std::string line;
  int count = 0;
  Columns columns{};
  while (std::getline(lines, line)) {
    const std::string where = fmt::format("{}:{}", source, ++count);
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const std::vector<std::string> words = columns_of(trimmed(line));
    if (!columns.kind) {
      columns = read_header(words, where, curves);
      continue;
    }
    if (words.size() != columns.count())
      fail(where, "the row has another number of columns than the header", std::to_string(words.size()),
           std::to_string(columns.count()));
    const Column &x = columns.kind->x, &y = columns.kind->y;
    Datum d;
    d.line = count;
    std::size_t next = 0;
    if (x.exists()) d.x = number(words[next++], where, x.name());
    d.y = number(words[next++], where, y.name());
    if (columns.sd) d.sd = number(words[next++], where, "the standard deviation");
    check(x, d.x, where), check(y, d.y, where);
    if (columns.sd) check({.quantity = "the standard deviation"}, d.sd, where);
    m.data.push_back(d);
    if (m.data.size() > most_rows) fail(source, "too many rows", {}, fmt::format("up to {}", most_rows));
  }
  if (!columns.kind) fail(source, "the file is empty", {}, known_headers());
  if (m.data.empty()) fail(source, "holds no row of numbers after the header");
  m.kind = columns.kind;
  m.kind->check_rows(m);
  return m;
}

Measurement read_measurement(const std::string& path, const Kind& curves)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) fail(path, "no such file");
  std::ifstream file(path);
  if (!std::filesystem::is_regular_file(path, ignored) || !file) fail(path, "cannot be read as a file");
  std::stringstream text;
  text << file.rdbuf();
  return parse_measurement(text.str(), path, curves);
}

}  // namespace granulaw
