#include "liggghts_plugin/books/contact_statistics.hpp"

#include <algorithm>

namespace granulaw::plugin {

namespace {

/// The lesser; 0: none.
double least_known(double a, double b)
{
  if (a == 0 || b == 0) return std::max(a, b);
  return std::min(a, b);
}

/// Two values of a quantity as one.
double combined(Combine how, double a, double b)
{
  return how == Combine::sum ? a + b : how == Combine::largest ? std::max(a, b) : std::min(a, b);
}

}  // namespace

void PairInfo::include(const PairInfo& other)
{
  if (kind.find(other.kind) == std::string::npos) kind += "/" + other.kind;
  overlap_limit = std::min(overlap_limit, other.overlap_limit);
  deep_overlap = std::min(deep_overlap, other.deep_overlap);
  damage_number_limit = least_known(damage_number_limit, other.damage_number_limit);
  stated.bound = stated.bound.worst(other.stated.bound);
  stated.size_off = std::max(stated.size_off, other.stated.size_off);
}

double ContactStatistics::Pair::deep() const
{
  double sum = 0;
  for (int b = 0; b < LogHistogram::bins; ++b)
    if (overlap.lower_edge(b) * (1 + 1e-9) >= info.deep_overlap)
      sum += std::max(0.0, overlap.count[static_cast<std::size_t>(b)]);
  return sum;
}

double ContactStatistics::damage_number_limit() const
{
  double limit = 0;
  for (const auto& [key, counts] : pairs)
    if (counts.info.needed) limit = least_known(limit, counts.info.damage_number_limit);
  return limit;
}

void ContactStatistics::Pair::merge(const Pair& other)
{
  for (const Quantity& q : quantities)
    q.value.of(*this) = combined(q.combine, q.value.of(*this), q.value.of(other));
  for (int b = 0; b < LogHistogram::bins; ++b) {
    speed.count[b] += other.speed.count[b];
    overlap.count[b] += other.overlap.count[b];
  }
  if (other.map.empty()) return;
  if (map.empty()) open_map();
  for (std::size_t k = 0; k < map.size(); ++k) map[k] += other.map[k];
}

void ContactStatistics::Pair::take_back_from(Pair& other)
{
  const auto move = [](auto& from, auto& to) {
    for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k)
      if (const double moved = std::min(-to[k], from[k]); moved > 0) from[k] -= moved, to[k] += moved;
  };
  move(other.overlap.count, overlap.count);
  move(other.map, map);
}

void ContactStatistics::count_ended()
{
  const auto less_than_none = [](const Pair& pair) {
    return std::any_of(pair.overlap.count.begin(), pair.overlap.count.end(), [](double n) { return n < 0; });
  };
  for (auto& [key, pair] : pairs) {
    if (!less_than_none(pair)) continue;
    for (auto& [other_key, other] : pairs) {
      // `set type` changes one particle of a pair at a time; a wall keeps its own
      const bool related = key.kind == PairKey::particles
                               ? key.i == other_key.i || key.i == other_key.j || key.j == other_key.i ||
                                     key.j == other_key.j
                               : key.j == other_key.j;
      if (key.kind == other_key.kind && related) pair.take_back_from(other);
    }
  }
  for (auto& [key, pair] : pairs) pair.count_ended();
}

void ContactStatistics::Pair::count_ended()
{
  ended = 0;
  overlap_min = std::numeric_limits<double>::infinity();
  // a contact may be older than the counts, which begin at zero where a restart file holds none
  for (double& one : overlap.count) one = std::max(0.0, one);
  for (double& one : map) one = std::max(0.0, one);
  for (int b = LogHistogram::bins - 1; b >= 0; --b) {
    ended += overlap.count[static_cast<std::size_t>(b)];
    if (overlap.count[static_cast<std::size_t>(b)] > 0) overlap_min = overlap.lower_edge(b);
  }
}

ContactStatistics::Pair ContactStatistics::Pair::in_si(const DeckUnits& units) const
{
  Pair si = *this;
  for (const Quantity& q : quantities)
    q.value.of(si) *= q.unit == Quantity::energy  ? units.energy()
                      : q.unit == Quantity::speed ? units.length
                                                  : 1.0;
  for (double* one : {&si.speed.first, &si.info.onset_speed}) *one *= units.length;
  return si;
}

ContactStatistics::Pair ContactStatistics::total(bool walls) const
{
  Pair sum;
  for (const auto& [key, counts] : pairs)
    if ((key.kind != PairKey::particles) == walls) sum.merge(counts);
  return sum;
}

ContactStatistics::Pair ContactStatistics::total() const
{
  Pair sum = total(false);
  sum.merge(total(true));
  return sum;
}

}  // namespace granulaw::plugin
