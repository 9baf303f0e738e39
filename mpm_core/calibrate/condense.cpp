#include "calibrate/condense.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace granulaw {

namespace {

constexpr double loading_share = 0.01;   // of the displacement
constexpr double unloading_ratio = 0.1;  // of the distance from the reversal point
constexpr double nearest = 1e-3;         // of the displacement: nearer rows are one datum
constexpr double touch = 0.01;           // of the largest force: contact is certain

/// Rows of one datum: the segment between two reversals of the displacement, and the place in it.
using Key = std::pair<std::size_t, long>;

/// A sum of rows, each weighed by its information.
struct Sum
{
  Datum first;
  double weight = 0, x = 0, y = 0;
  int rows = 0;

  void add(const Datum& d)
  {
    const double w = d.sd > 0 ? 1 / (d.sd * d.sd) : 1;
    if (rows == 0) first = d;
    weight += w, x += w * d.x, y += w * d.y, rows += d.rows;
  }
  Datum mean() const
  {
    Datum d = first;
    if (rows == d.rows) return d;
    d.x = x / weight, d.y = y / weight, d.rows = rows;
    if (d.sd > 0) d.sd = 1 / std::sqrt(weight);
    return d;
  }
};

}  // namespace

void condense(Measurement& m, double width)
{
  const std::vector<Datum>& rows = m.data;
  const double largest = m.largest_y();
  const double begin =
      std::find_if(rows.begin(), rows.end(), [&](const Datum& d) { return d.y > touch * largest; })->x;
  const double length = m.largest_x() - begin;
  if (!(length > 0)) return;
  std::vector<Key> keys;
  std::size_t segment = 0, next = 0;
  const auto loading_until = [&](std::size_t end) {
    for (; next < end; ++next)
      keys.emplace_back(segment, std::lround(std::max(rows[next].x - begin, -0.1 * length) /
                                             (width * loading_share * length)));
    ++segment;
  };
  for (const Unloading& u : m.unloadings()) {
    loading_until(u.first);
    const auto at = [&](std::size_t k) { return rows.begin() + static_cast<std::ptrdiff_t>(k); };
    const auto shallower = [](const Datum& a, const Datum& b) { return a.x < b.x; };
    const auto lowest =
        static_cast<std::size_t>(std::min_element(at(u.first), at(u.last), shallower) - rows.begin());
    const double top = std::max(rows[u.first].x, rows[u.first - 1].x);
    for (; next < u.last; ++next) {
      if (next == lowest + 1) ++segment;
      const double distance = std::max((top - rows[next].x) / length, nearest);
      keys.emplace_back(segment, std::lround(std::log(distance) / (width * unloading_ratio)));
    }
    ++segment;
    // the rows that bound the reversal point
    for (std::size_t k = u.first - std::min<std::size_t>(3, u.first); k <= u.first; ++k)
      keys[k] = {segment++, 0};
  }
  loading_until(rows.size());
  std::vector<Sum> sums;
  std::map<Key, std::size_t> place;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto [at, is_new] = place.try_emplace(keys[k], sums.size());
    if (is_new) sums.emplace_back();
    sums[at->second].add(rows[k]);
  }
  m.data.clear();
  for (const Sum& s : sums) m.data.push_back(s.mean());
}

}  // namespace granulaw
