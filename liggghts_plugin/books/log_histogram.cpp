#include "liggghts_plugin/books/log_histogram.hpp"

#include <limits>

namespace granulaw::plugin {

const std::array<double, LogHistogram::bins + 2> LogHistogram::upper_ratio = [] {
  std::array<double, bins + 2> ratio{};
  ratio.fill(std::numeric_limits<double>::infinity());
  for (int b = 0; b + 1 < bins; ++b)
    ratio[static_cast<std::size_t>(b)] = std::pow(10.0, (b + 1.0) / per_decade);
  return ratio;
}();

const std::array<std::size_t, LogHistogram::octaves> LogHistogram::first_of_octave = [] {
  std::array<std::size_t, octaves> first{};
  for (std::size_t k = 0; k < octaves; ++k)
    while (first[k] + 1 < bins && std::pow(10.0, (static_cast<double>(first[k]) + 1.0) / per_decade) <=
                                      std::ldexp(1.0, static_cast<int>(k)))
      ++first[k];
  return first;
}();

}  // namespace granulaw::plugin
