#include "calibrate/measurement_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/text_table.hpp"

namespace granulaw {

namespace {

constexpr std::size_t most_rows = 200000;  // half an hour at 100 Hz

/// A reading of a rebound tester: 1000 e, at the speed of its device.
constexpr Column leeb{.quantity = "leeb_hardness", .most = 1000};

std::string known_headers()
{
  std::string all = leeb.name() + "; ";
  for (const std::string& header : measurement_headers()) all += header + "; ";
  return all + "each with NAME_sd of the last column, if known";
}

/// Units as they are written: "m/s" for "m_per_s", "-" for a pure number; in brackets or not.
bool is_unit(std::string word, const std::string& unit)
{
  std::erase_if(word, [](char c) { return std::string(" []()").find(c) != std::string::npos; });
  if (word == unit) return true;
  if (unit == "m_per_s") return word == "m/s" || word == "ms-1" || word == "ms^-1";
  return unit.empty() && (word == "-" || word == "1");
}

std::string lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

/// A word of the header as the kinds spell it: "Force [N]", or "force" above the unit "N", is "force_N".
std::string spelled(const std::string& word, const std::string& unit, const std::string& where)
{
  for (const Kind* kind : kinds())
    for (const Column& known : {kind->x, kind->y})
      for (const std::string ending : {"", "_sd"}) {
        if (!known.exists()) continue;
        const std::string quantity = known.quantity + ending, name = known.name() + ending;
        const bool has_unit = lower(word) == lower(name);
        if (!unit.empty() && (has_unit || lower(word) == quantity)) {
          if (is_unit(unit, known.unit)) return name;
          fail(where, fmt::format("the unit of '{}' is no SI unit of it", cut(word)), fmt::format("'{}'", cut(unit)),
               *known.unit ? known.unit : "-");
        }
        if (has_unit) return name;
        const auto bracket = word.find_first_of("[(");
        if (bracket == std::string::npos || !is_unit(word.substr(bracket), known.unit)) continue;
        if (lower(word.substr(0, word.find_last_not_of(" _[(", bracket) + 1)) == quantity) return name;
      }
  return word;
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
  bool sd, is_leeb = false;
  bool has_x() const { return kind->x.exists() && !is_leeb; }
  std::size_t count() const { return (has_x() ? 2 : 1) + (sd ? 1 : 0); }
};

Columns read_header(const std::vector<std::string>& words, const std::string& where, const Kind& curves)
{
  const std::string found = fmt::format("{}", fmt::join(words, ","));
  for (const bool sd : {false, true})
    if (found == leeb.name() + (sd ? "," + leeb.name() + "_sd" : "")) return {&kind_named("restitution", where), sd, true};
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
  if (!is_number(word)) fail(where, fmt::format("'{}' is no number", column), fmt::format("'{}'", cut(word)), "a number");
  const double value = std::strtod(word.c_str(), nullptr);
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
  std::vector<TextRow> rows = parse_table(text, source);
  if (rows.empty()) fail(source, "the file is empty", {}, known_headers());
  const auto where = [&](const TextRow& row) { return fmt::format("{}:{}", source, row.line); };
  std::size_t first = 1;
  point_decimals(rows, first, source);
  std::vector<std::string> header = rows[0].words, units(header.size());
  const bool has_units = rows.size() > 1 && rows[1].words.size() <= header.size() &&
                         std::none_of(rows[1].words.begin(), rows[1].words.end(), is_number);
  if (has_units) std::copy(rows[1].words.begin(), rows[1].words.end(), units.begin()), ++first;
  for (std::size_t k = 0; k < header.size(); ++k) header[k] = spelled(header[k], units[k], where(rows[first - 1]));
  const Columns columns = read_header(header, where(rows[0]), curves);
  if (rows.size() - first > most_rows) fail(source, "too many rows", {}, fmt::format("up to {}", most_rows));
  for (std::size_t k = first; k < rows.size(); ++k) {
    const std::vector<std::string>& words = rows[k].words;
    const std::string here = where(rows[k]);
    if (words.size() != columns.count())
      fail(here,
           words.size() == 2 * columns.count() ? "the row has twice as many columns as the header, as if commas were "
                                                 "decimal ones and separated columns, too"
                                               : "the row has another number of columns than the header",
           std::to_string(words.size()), std::to_string(columns.count()));
    const Column &x = columns.kind->x, &y = columns.is_leeb ? leeb : columns.kind->y;
    Datum d;
    d.line = rows[k].line;
    std::size_t next = 0;
    if (columns.has_x()) d.x = number(words[next++], here, x.name());
    d.y = number(words[next++], here, y.name());
    if (columns.sd) d.sd = number(words[next++], here, "the standard deviation");
    if (columns.has_x()) check(x, d.x, here);
    check(y, d.y, here);
    if (columns.sd) check({.quantity = "the standard deviation"}, d.sd, here);
    if (columns.is_leeb && !(d.y < leeb.most))
      fail(here, fmt::format("'{}' is out of range", leeb.name()), fmt::format("{:g}", d.y), "below 1000: 1000 times the rebound speed over the impact's");
    if (columns.is_leeb) d.y /= leeb.most, d.sd /= leeb.most;
    m.data.push_back(d);
  }
  m.is_leeb = columns.is_leeb;
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
