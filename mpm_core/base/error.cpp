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

std::string printable(std::string_view text)
{
  std::string result(text);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto c = static_cast<unsigned char>(result[k]);
    // 0x80 to 0x9f: as UTF-8, C2 80 to C2 9F, terminals take them for escapes as well (CSI is U+009B)
    const bool c1 = c == 0xc2 && k + 1 < result.size() && static_cast<unsigned char>(result[k + 1]) < 0xa0;
    const bool alone = c >= 0x80 && c < 0xa0 && (k == 0 || static_cast<unsigned char>(result[k - 1]) < 0x80);
    if (c < 0x20 || c == 0x7f || alone) result[k] = '?';
    if (c1) result[k] = result[k + 1] = '?';
  }
  return result;
}

void fail(std::string_view where, std::string_view what, std::string_view found, std::string_view allowed)
{
  std::string sentence = where.empty() ? std::string(what) : fmt::format("{}: {}", where, what);
  if (!found.empty()) sentence += fmt::format(": found {}", found);
  if (!allowed.empty()) sentence += fmt::format("{} allowed is {}", found.empty() ? ":" : ",", allowed);
  throw Error(printable(sentence));  // what was found may come from a hostile file
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

std::string cut(std::string_view text, std::size_t longest)
{
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

std::string list_of(std::span<const std::string> words)
{
  constexpr std::size_t most = 20;
  std::string list;
  for (const std::string& word : words.first(std::min(words.size(), most)))
    list += (list.empty() ? "" : ", ") + cut(word);
  if (words.size() > most) list += fmt::format(", ... ({} in all)", words.size());
  return list;
}

void fail_unknown(std::string_view where, std::string_view what, std::string_view word,
                  std::span<const std::string> known, std::string_view more)
{
  fail(where, fmt::format("{} '{}'{}", what, cut(word), did_you_mean(word, known)), {},
       list_of(known) + std::string(more));
}

}  // namespace granulaw
