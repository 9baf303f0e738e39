#include "calibrate/pull_off.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "calibrate/text_table.hpp"
#include "contact/adhesion.hpp"

namespace granulaw {

std::vector<PullOff> parse_pull_offs(const std::string& text, const std::string& source)
{
  std::vector<TextRow> rows = parse_table(text, source);
  point_decimals(rows, 1, source);
  if (rows.empty() || rows.front().words != std::vector<std::string>{"preload_N", "pull_off_N"})
    fail(source, "is no file of pull-off forces: its first line must be", "", "preload_N,pull_off_N");
  std::vector<PullOff> data;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const auto& words = rows[k].words;
    const auto value = [&](std::size_t column) { return column < words.size() && is_number(words[column]) ? std::strtod(words[column].c_str(), nullptr) : 0.0; };
    const PullOff one{value(0), value(1)};
    if (words.size() != 2 || !(one.preload > 0 && one.pull_off > 0 && std::isfinite(one.preload * one.pull_off)))
      fail(fmt::format("{}:{}", source, rows[k].line), "two numbers over 0 are needed: preload and pull-off force, N");
    data.push_back(one);
  }
  if (data.empty()) fail(source, "holds no pull-off force");
  return data;
}

std::vector<PullOff> read_pull_offs(const std::string& path)
{
  std::ifstream file(path);
  if (!file) fail(path, "cannot be read");
  std::stringstream text;
  text << file.rdbuf();
  return parse_pull_offs(text.str(), path);
}

namespace {

/// Overlap of a slow press to this force, m.
double depth_of(const Tabulated& law, double r_eff, double force, const std::string& source)
{
  double low = 0, high = law.largest_overlap() * r_eff;
  if (!(law.loading(r_eff, high, 0.0) >= force))
    fail(source, "a preload goes deeper than the law", fmt::format("{:.4g} N", force), fmt::format("up to {:.4g} N", law.loading(r_eff, high, 0.0)));
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (low + high);
    (law.loading(r_eff, middle, 0.0) < force ? low : high) = middle;
  }
  return high;
}

}  // namespace

FoundAdhesion fit_adhesion(const PairLaw& pair, double r_eff, const std::vector<PullOff>& data, double range, const std::string& source)
{
  const Tabulated law(pair, pair.measure(), {});
  std::vector<double> depths;
  for (const PullOff& d : data) depths.push_back(depth_of(law, r_eff, d.preload, source));
  const auto n = static_cast<double>(data.size());
  const auto off = [&](double work, std::size_t k) { return std::log(data[k].pull_off / DentAdhesion(law, work, range).pull_off(law, r_eff, depths[k])); };
  const auto mean_off = [&](double work) {
    double sum = 0;
    for (std::size_t k = 0; k < data.size(); ++k) sum += off(work, k);
    return sum / n;
  };
  // the mean falls with w: its slope by ln w is about -0.9
  double low = std::log(1e-9), high = std::log(1e4);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_off(std::exp(middle)) > 0 ? low : high) = middle;
  }
  FoundAdhesion found;
  found.work = std::exp(high);
  const DentAdhesion piece(law, found.work, range);
  for (const double depth : depths)
    if (const std::string why = piece.fault(law, r_eff, depth); !why.empty())
      fail(source, fmt::format("the best work of adhesion is {:.3g} J/m2, and {}", found.work, why));
  double squares = 0, mean_load = 0, loads = 0, product = 0;
  for (const PullOff& d : data) mean_load += std::log(d.preload) / n;
  for (std::size_t k = 0; k < data.size(); ++k) {
    const double r = off(found.work, k), x = std::log(data[k].preload) - mean_load;
    squares += r * r, loads += x * x, product += x * r;
  }
  double half = 0;  // the law's errors at neighbouring dents are alike: their mean
  for (const double depth : depths) half += piece.numbers(law, r_eff, depth).pull_off_bound() / n;
  if (data.size() > 1) {
    found.scatter = std::sqrt(squares / (n - 1));
    half = std::hypot(half, boost::math::quantile(boost::math::students_t(n - 1), 0.975) * found.scatter / std::sqrt(n));
  }
  if (data.size() > 2 && loads > 0) {
    found.trend = product / loads;
    found.trend_sd = std::sqrt(std::max(squares - product * product / loads, 0.0) / (n - 2) / loads);
  }
  const double slope = (mean_off(found.work * 0.99) - mean_off(found.work * 1.01)) / std::log(1.01 / 0.99);  // d ln(pull-off)/d ln w
  found.low = found.work * std::exp(-half / slope), found.high = found.work * std::exp(half / slope);
  return found;
}

}  // namespace granulaw
