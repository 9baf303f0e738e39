#include "calibrate/measurement_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace granulaw {

namespace {

/// The header of a kind.
struct Header
{
  const char *x, *y;  ///< x empty: the kind has one column
  MeasurementKind kind;
};
constexpr Header headers[] = {
    {"velocity_m_per_s", "restitution", MeasurementKind::restitution},
    {"velocity_m_per_s", "contact_radius_m", MeasurementKind::contact_radius},
    {"velocity_m_per_s", "residual_displacement_m", MeasurementKind::residual_displacement},
    {"velocity_m_per_s", "contact_time_s", MeasurementKind::contact_time},
    {"displacement_m", "force_N", MeasurementKind::platens},
    {"", "hardness_Pa", MeasurementKind::hardness},
    {"", "onset_force_N", MeasurementKind::onset_force}};

constexpr std::size_t most_rows = 20000;

std::string name_of(const Header& h)
{
  return *h.x ? fmt::format("{},{}", h.x, h.y) : std::string(h.y);
}

std::string known_headers()
{
  std::string all;
  for (const Header& h : headers) all += (all.empty() ? "" : "; ") + name_of(h);
  return all + "; each with NAME_sd of the last column, if known";
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

/// A name without its unit: "velocity" of "velocity_m_per_s".
std::string quantity_of(const std::string& column)
{
  for (const char* unit : {"_m_per_s", "_m", "_N", "_Pa", "_s"})
    if (column.ends_with(unit)) return column.substr(0, column.size() - std::string(unit).size());
  return column;
}

/// Fails where a column of the header is a known quantity without its unit.
void complain_of_units(const std::vector<std::string>& columns, const std::string& where)
{
  for (const std::string& column : columns)
    for (const Header& h : headers)
      for (const std::string known : {h.x, h.y})
        if (!known.empty() && known != column && quantity_of(known) != known &&
            (column == quantity_of(known) || column.starts_with(quantity_of(known) + "_") ||
             column.starts_with(quantity_of(known) + " ") || column.starts_with(quantity_of(known) + "[")) &&
            !column.ends_with("_sd"))
          fail(where, "a column must name its unit, SI", fmt::format("'{}'", cut(column)),
               fmt::format("'{}'", known));
}

/// The kind of a header, and whether it has a column of standard deviations.
struct Columns
{
  const Header* header;
  bool sd;
  std::size_t count() const { return (*header->x ? 2 : 1) + (sd ? 1 : 0); }
};

Columns read_header(const std::vector<std::string>& words, const std::string& where)
{
  for (const Header& h : headers) {
    std::vector<std::string> wanted;
    if (*h.x) wanted.emplace_back(h.x);
    wanted.emplace_back(h.y);
    if (words == wanted) return {&h, false};
    const std::string sd = quantity_of(h.y) + "_sd", sd_unit = std::string(h.y) + "_sd";
    wanted.push_back(sd);
    if (words == wanted) return {&h, true};
    wanted.back() = sd_unit;
    if (words == wanted) return {&h, true};
  }
  complain_of_units(words, where);
  std::string found;
  for (const std::string& w : words) found += (found.empty() ? "" : ",") + w;
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

void require(bool good, const std::string& where, const char* column, double value, const char* allowed)
{
  if (!good) fail(where, fmt::format("'{}' is out of range", column), fmt::format("{:g}", value), allowed);
}

void check(const Datum& d, const Columns& c, const std::string& where)
{
  const Header& h = *c.header;
  if (is_impact(h.kind)) require(d.x > 0, where, h.x, d.x, "over 0 m/s");
  if (is_curve(h.kind))
    require(d.y > -1e9, where, h.y, d.y, "a force, pushing is positive");
  else
    require(d.y > 0, where, h.y, d.y, "over 0");
  if (c.sd) require(d.sd > 0, where, "the standard deviation", d.sd, "over 0");
}

/// Work of some rows of a curve between two displacements, by trapezes.
double work_of(const std::vector<Datum>& rows, double low, double high)
{
  double work = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Datum &a = rows[k - 1], &b = rows[k];
    if (a.x == b.x) continue;
    const auto force = [&](double x) { return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x); };
    const double from = std::clamp(a.x, low, high), to = std::clamp(b.x, low, high);
    work += 0.5 * (force(from) + force(to)) * (to - from);
  }
  return std::abs(work);
}

/// No contact gives back more work than it took: rows that say so stand in the wrong order.
void check_order(const Measurement& m)
{
  constexpr double noise = 0.1;  // of the work: trapezes of few rows, and their noise
  const auto top = m.data.begin() + static_cast<std::ptrdiff_t>(m.reversal());
  const std::vector<Datum> loading(m.data.begin(), top + 1), unloading(top, m.data.end());
  if (unloading.size() < 3) return;
  const double low = std::max(loading.front().x, unloading.back().x), high = top->x;
  const double taken = work_of(loading, low, high), given = work_of(unloading, low, high);
  if (given > (1 + noise) * taken)
    fail(m.source, "unloading gives back more work than loading took, as if the rows stood in reverse order",
         fmt::format("{:.3g} J of {:.3g} J", given, taken), "loading rows first, then unloading rows");
}

/// What the rows together must be.
void check_all(const Measurement& m)
{
  if (m.data.empty()) fail(m.source, "holds no row of numbers after the header");
  if (!is_curve(m.kind)) return;
  if (m.data.size() < 5)
    fail(m.source, "a curve of force needs more rows", std::to_string(m.data.size()), "5 or more");
  double least = m.data.front().x, most = least, force = 0;
  for (const Datum& d : m.data) {
    least = std::min(least, d.x), most = std::max(most, d.x), force = std::max(force, d.y);
  }
  if (!(most > least)) fail(m.source, "the displacement is the same in all rows");
  if (!(force > 0)) fail(m.source, "no force is over 0: pushing is positive");
  if (m.reversal() < 4)
    fail(m.source, "loading rows come first, then unloading rows: the largest displacement stands in row",
         std::to_string(m.reversal() + 1), "the fifth or a later one");
  check_order(m);
}

}  // namespace

Measurement parse_measurement(const std::string& text, const std::string& source, MeasurementKind curves)
{
  Measurement m;
  m.source = source;
  std::stringstream lines(text);
  std::string line;
  int count = 0;
  const Header* header = nullptr;
  Columns columns{};
  while (std::getline(lines, line)) {
    ++count;
    const std::string where = fmt::format("{}:{}", source, count);
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const std::vector<std::string> words = columns_of(trimmed(line));
    if (!header) {
      columns = read_header(words, where);
      header = columns.header;
      m.kind = is_curve(header->kind) ? curves : header->kind;
      continue;
    }
    if (words.size() != columns.count())
      fail(where, "the row has another number of columns than the header", std::to_string(words.size()),
           std::to_string(columns.count()));
    Datum d;
    d.line = count;
    std::size_t next = 0;
    if (*header->x) d.x = number(words[next++], where, header->x);
    d.y = number(words[next++], where, header->y);
    if (columns.sd) d.sd = number(words[next++], where, "the standard deviation");
    check(d, columns, where);
    m.data.push_back(d);
    if (m.data.size() > most_rows) fail(source, "too many rows", {}, fmt::format("up to {}", most_rows));
  }
  if (!header) fail(source, "the file is empty", {}, known_headers());
  check_all(m);
  return m;
}

Measurement read_measurement(const std::string& path, MeasurementKind curves)
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
