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
  std::size_t bin(double value) const { return bin_of_ratio(value / first); }
  /// The bin of `ratio` times the lower edge. Without a logarithm, a division or a branch: each contact that
  /// grows deeper asks, and no processor can foresee which of an octave's bins it is in.
  static std::size_t bin_of_ratio(double ratio)
  {
    // floor(log2 ratio), the exponent of the number, gives the bin but for the two behind it
    const auto octave =
        static_cast<std::size_t>((std::bit_cast<std::uint64_t>(std::max(1.0, ratio)) >> 52) - 1023);
    const std::size_t lowest = first_of_octave[std::min(octave, octaves - 1)];
    const double* const upper = &upper_ratio[lowest];
    const std::size_t above = static_cast<std::size_t>(ratio >= upper[0]) +
                              static_cast<std::size_t>(ratio >= upper[1]) +
                              static_cast<std::size_t>(ratio >= upper[2]);
    return std::min<std::size_t>(lowest + above, bins - 1);
  }
  void add(double value, double weight) { count[bin(value)] += weight; }
  /// True if the bin's upper edge is above `ratio` times the lower edge of bin 0.
  static bool ends_above_ratio(std::size_t bin, double ratio) { return ratio < upper_ratio[bin]; }
  double lower_edge(int bin) const { return first * std::pow(10.0, static_cast<double>(bin) / per_decade); }

 private:
  static constexpr std::size_t octaves = 64;
  /// Ratio of each bin's upper edge to `first`; infinity from the last bin on.
  static const std::array<double, bins + 2> upper_ratio;
  static const std::array<std::size_t, octaves> first_of_octave;  ///< bin of 2^octave
};

}  // namespace granulaw::plugin
