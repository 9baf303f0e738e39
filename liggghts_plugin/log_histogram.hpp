#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace granulaw::plugin {

/// Counts in logarithmic bins, eight a decade, from `first` (lower edge of bin 0); the outer bins catch the
/// rest.
struct LogHistogram
{
  static constexpr int bins = 80, per_decade = 8;
  double first;
  std::array<double, bins> count{};

  explicit LogHistogram(double lower_edge) : first(lower_edge) {}
  /// Without a logarithm: each contact that grows deeper asks.
  std::size_t bin(double value) const
  {
    const double ratio = value / first;
    if (!(ratio > 1.0)) return 0;
    // floor(log2 ratio), the exponent of the number, tells the bin but for the two behind it
    const auto octave = static_cast<std::size_t>((std::bit_cast<std::uint64_t>(ratio) >> 52) - 1023);
    std::size_t found = first_of_octave[std::min(octave, octaves - 1)];
    while (found + 1 < bins && ratio >= upper_ratio[found]) ++found;
    return found;
  }
  void add(double value, double weight) { count[bin(value)] += weight; }
  /// Whether the bin's upper edge is above `value`.
  bool ends_above(std::size_t bin, double value) const { return value / first < upper_ratio[bin]; }
  double lower_edge(int bin) const { return first * std::pow(10.0, static_cast<double>(bin) / per_decade); }

 private:
  static constexpr std::size_t octaves = 64;
  static const std::array<double, bins> upper_ratio;              ///< of each bin's upper edge to `first`
  static const std::array<std::size_t, octaves> first_of_octave;  ///< bin of 2^octave
};

}  // namespace granulaw::plugin
