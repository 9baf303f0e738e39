#include "base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace granulaw {

namespace {

/// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

void fail(std::string_view where, std::string_view what, std::string_view found, std::string_view allowed)
{
  std::string sentence = where.empty() ? std::string(what) : fmt::format("{}: {}", where, what);
  if (!found.empty()) sentence += fmt::format(": found {}", found);
  if (!allowed.empty()) sentence += fmt::format("{} allowed is {}", found.empty() ? ":" : ",", allowed);
  // What was found may come from a hostile file: no line breaks, no commands to the terminal.
  for (char& c : sentence)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  throw Error(sentence);
}

std::string nearest(std::string_view word, std::span<const std::string> candidates)
{
  std::string best;
  std::size_t best_distance = word.size() / 2 + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates)
{
  const std::string near = nearest(word, candidates);
  return near.empty() ? std::string{} : fmt::format(" (did you mean '{}'?)", near);
}

}  // namespace granulaw
