#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace granulaw::plugin {

/// Counts in logarithmic bins, eight a decade, from `first` (lower edge of bin 0); the outer bins catch the
/// rest.
struct LogHistogram
{
  static constexpr int bins = 80, per_decade = 8;
  double first;
  std::array<double, bins> count{};

  explicit LogHistogram(double lower_edge) : first(lower_edge) {}
  void add(double value, double weight)
  {
    const double position = value > first ? per_decade * std::log10(value / first) : 0.0;
    count[static_cast<std::size_t>(std::min(position, bins - 1.0))] += weight;
  }
  double lower_edge(int bin) const { return first * std::pow(10.0, static_cast<double>(bin) / per_decade); }
};

/// What the contacts of this rank did since the pair style was set. Filled by the contact loops.
///
/// A pair of a local particle and a ghost is computed on both ranks (or twice on one, across a periodic
/// boundary): it counts with `weight` 1/2 each time, so that sums over ranks are right.
struct ContactLedger
{
  struct Side
  {
    double dissipated = 0;     ///< J: loading work minus recoverable work, from the law's own work functions
    double touches = 0;        ///< contacts that began
    double ended = 0;          ///< contacts that ended
    double speed_max = 0;      ///< m/s, largest approach speed at first touch
    double overlap_max = 0;    ///< largest overlap/R*
    double inertia_max = 0;    ///< largest I = rho V^2/Y at first touch (V: the yielding body's share)
    double beyond = 0;         ///< contact-steps beyond the law's table
    double too_fast = 0;       ///< contacts that began faster than the law's inertia axis goes
    LogHistogram speed{1e-6};  ///< approach speed at first touch, m/s
    LogHistogram overlap{1e-10};  ///< largest overlap/R* of each contact that ended
  };
  Side pair, wall;

  void clear() { *this = ContactLedger{}; }
};

/// `ledger` (summed over ranks) as JSON; `header` is placed first ("\"key\": value,\n" lines).
std::string to_json(const ContactLedger& ledger, const std::string& header);

}  // namespace granulaw::plugin
