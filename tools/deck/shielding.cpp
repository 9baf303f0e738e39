#include "deck/shielding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace granulaw::deck {

namespace {

struct Fall
{
  double speed = 0;       // m/s, unhindered
  std::size_t below = 0;  // spheres in its column
};

/// So many of a cell's spheres, the highest first, are enough: nothing comes through that many.
constexpr std::size_t most_of_a_cell = 200;

struct Columns
{
  std::vector<Fall> falls;
  std::array<double, 20>
      offsets{};  // pairs of a column, by the square of their distance aside over a diameter's
};

/// Counts each sphere's column, from the lowest up, in a grid of cells across gravity.
Columns columns(const Cloud& c)
{
  const std::array<std::size_t, 2> across{c.axis == 0 ? 1u : 0u, c.axis == 2 ? 1u : 2u};
  Box box;
  for (const Vec3& p : c.centres) box.include(p);
  std::array<double, 2> low{}, side{}, cell{};
  std::array<std::size_t, 2> cells{};
  std::array<bool, 2> wraps{};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t a = across[k];
    wraps[k] = c.periodic[a] && std::isfinite(c.domain.size()[a]) && c.domain.size()[a] > 6 * c.radius;
    low[k] = wraps[k] ? c.domain.low[a] : box.low[a];
    side[k] = (wraps[k] ? c.domain.high[a] : box.high[a]) - low[k];
    cells[k] = static_cast<std::size_t>(std::clamp(side[k] / (2 * c.radius), 1.0, 2000.0));
    cell[k] = std::max(side[k], 2 * c.radius) / static_cast<double>(cells[k]);
  }
  std::vector<std::vector<std::size_t>> inside(cells[0] * cells[1]);
  const auto height = [&](std::size_t i) { return c.up * (c.centres[i][c.axis] - c.floor) - c.radius; };
  std::vector<std::size_t> order(c.centres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return height(i) < height(j); });

  Columns result;
  for (const std::size_t i : order) {
    std::array<long, 2> at{};
    for (std::size_t k = 0; k < 2; ++k)
      at[k] = static_cast<long>(
          std::clamp((c.centres[i][across[k]] - low[k]) / cell[k], 0.0, static_cast<double>(cells[k]) - 1));
    Fall fall{std::sqrt(2 * c.g * std::max(0.0, height(i))), 0};
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy) {
        std::array<long, 2> near{at[0] + dx, at[1] + dy};
        bool there = true;
        for (std::size_t k = 0; k < 2; ++k) {
          const long n = static_cast<long>(cells[k]);
          if (wraps[k]) near[k] = (near[k] + n) % n;
          there = there && near[k] >= 0 && near[k] < n;
        }
        if (!there) continue;
        const auto& lower =
            inside[static_cast<std::size_t>(near[0]) * cells[1] + static_cast<std::size_t>(near[1])];
        const std::size_t some = std::min(lower.size(), most_of_a_cell);
        for (auto at_j = lower.rbegin(); at_j != lower.rbegin() + static_cast<std::ptrdiff_t>(some); ++at_j) {
          const std::size_t j = *at_j;
          double aside = 0;
          for (std::size_t k = 0; k < 2; ++k) {
            double d = c.centres[i][across[k]] - c.centres[j][across[k]];
            if (wraps[k]) d -= side[k] * std::round(d / side[k]);
            aside += d * d;
          }
          const double share = aside / (4 * c.radius * c.radius);
          if (share >= 1) continue;
          ++fall.below;
          ++result.offsets[static_cast<std::size_t>(share * static_cast<double>(result.offsets.size()))];
        }
      }
    inside[static_cast<std::size_t>(at[0]) * cells[1] + static_cast<std::size_t>(at[1])].push_back(i);
    result.falls.push_back(fall);
  }
  return result;
}

/// Carriers of the speed `fall.speed` that land faster than `speed`, in the mean.
double faster(const Fall& fall, double speed)
{
  if (fall.speed <= speed) return 0;
  if (fall.below == 0) return 1;
  // 2^m P(m, L) = 2^m exp(-L) sum over k >= m of L^k/k!
  const double m = static_cast<double>(fall.below), l = std::log(fall.speed / speed);
  const double log_first = m * std::log(2 * l) - l - std::lgamma(m + 1);
  if (log_first < -60) return 0;
  double sum = 0, term = 1;
  for (double k = m; term > 1e-9 * sum || k <= l; ++k) sum += term, term *= l / (k + 1);
  return std::exp(log_first) * sum;
}

}  // namespace

double landing_speed(const Cloud& cloud, double expected)
{
  const std::vector<Fall> all = columns(cloud).falls;
  double low = 0, high = 0;
  for (const Fall& f : all) {
    if (f.below == 0) low = std::max(low, f.speed);
    high = std::max(high, f.speed);
  }
  const auto exceed = [&](double speed) {
    double sum = 0;
    for (const Fall& f : all) sum += faster(f, speed);
    return sum;
  };
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    (exceed(middle) > expected ? low : high) = middle;
  }
  return high;
}

bool at_random(const Cloud& cloud)
{
  const Columns all = columns(cloud);
  const double pairs = std::accumulate(all.offsets.begin(), all.offsets.end(), 0.0);
  if (pairs < 100) return false;  // too few to decide: by chance alone 0.1 is exceeded once in four
  double below = 0, largest = 0;
  for (std::size_t k = 0; k < all.offsets.size(); ++k) {
    below += all.offsets[k] / pairs;
    const double even = static_cast<double>(k + 1) / static_cast<double>(all.offsets.size());
    largest = std::max(largest, std::abs(below - even));
  }
  return largest < 0.1;
}

}  // namespace granulaw::deck
