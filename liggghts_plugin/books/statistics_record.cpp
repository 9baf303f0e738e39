// ContactStatistics as numbers, for restart files.
#include <algorithm>

#include "liggghts_plugin/books/contact_statistics.hpp"

namespace granulaw::plugin {

namespace {

constexpr std::size_t key_length = 3;
constexpr std::size_t side_length = key_length + quantities.size() + 2 * LogHistogram::bins;

/// First number of pack(); negative, as no kind of a key is.
constexpr double layout = -static_cast<double>(side_length);
constexpr int map_record = 100;  // added to the kind of a key in pack(): what follows is its map

}  // namespace

std::vector<double> ContactStatistics::pack() const
{
  std::vector<double> values{layout};
  for (const auto& [key, counts] : pairs) {
    values.insert(values.end(),
                  {static_cast<double>(key.kind), static_cast<double>(key.i), static_cast<double>(key.j)});
    for (const Quantity& q : quantities) values.push_back(q.value.of(counts));
    values.insert(values.end(), counts.speed.count.begin(), counts.speed.count.end());
    values.insert(values.end(), counts.overlap.count.begin(), counts.overlap.count.end());
  }
  for (const auto& [key, counts] : pairs) {
    if (counts.map.empty()) continue;
    values.insert(values.end(), {static_cast<double>(map_record + key.kind), static_cast<double>(key.i),
                                 static_cast<double>(key.j), 0.0});
    const std::size_t length = values.size() - 1;
    for (std::size_t k = 0; k < counts.map.size(); ++k)
      if (counts.map[k] != 0) values.insert(values.end(), {static_cast<double>(k), counts.map[k]});
    values[length] = static_cast<double>(values.size() - length - 1);
  }
  return values;
}

bool ContactStatistics::unpack(const double* values, std::size_t count, bool sums)
{
  if (count == 0 || values[0] != layout) return false;
  for (auto& [key, counts] : pairs) {
    Pair fresh;
    fresh.info = counts.info;
    if (!counts.map.empty()) fresh.open_map();
    counts = fresh;
  }
  const double *v = values + 1, *end = values + count;
  for (; v + side_length <= end && v[0] < map_record; v += side_length) {
    Pair& counts = pairs[{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])}];
    const double* from = v + key_length;
    for (const Quantity& q : quantities) {
      if (sums || q.combine != Combine::sum) q.value.of(counts) = *from;
      ++from;
    }
    if (!sums) continue;
    std::copy_n(from, LogHistogram::bins, counts.speed.count.begin());
    std::copy_n(from + LogHistogram::bins, LogHistogram::bins, counts.overlap.count.begin());
  }
  if (!sums) return true;
  while (v + key_length < end) {
    Pair& counts =
        pairs[{static_cast<int>(v[0]) - map_record, static_cast<int>(v[1]), static_cast<int>(v[2])}];
    counts.open_map();
    v += key_length + 1;
    const double length = v[-1];
    const double* record_end = length >= 0 && length < static_cast<double>(end - v) ? v + static_cast<std::size_t>(length) : end;
    for (; v + 1 < record_end; v += 2)
      if (v[0] >= 0 && v[0] < static_cast<double>(counts.map.size()))
        counts.map[static_cast<std::size_t>(v[0])] = v[1];
    v = record_end;
  }
  return true;
}

}  // namespace granulaw::plugin
