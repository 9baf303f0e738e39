#pragma once

#include <span>
#include <vector>

#include "solver/output/trace.hpp"

namespace granulaw {

/// Treatment of the contact-edge grid noise.
///
/// The contact radius of a grid grows by whole cells; the force swings about its mean by 0.5 % (elastic) to 3
/// % (plastic). The treated loading force is a weighted least-squares polynomial of ln F in ln delta through
/// the virgin loading samples: it cannot follow the grid noise (several periods over the range) but follows
/// the law.
class TreatedLoading
{
 public:
  TreatedLoading() = default;
  /// Fits the load branch of `trace` between `from` times the largest delta and the largest delta.
  /// With fewer than 12 usable samples nothing is fitted and valid() is false.
  explicit TreatedLoading(std::span<const TraceSample> trace, double from = 0.08);

  bool valid() const { return !coefficients_.empty(); }
  /// Treated force at overlap delta (same units as the trace); meaningful within the fitted range.
  double force(double delta) const;
  /// Largest treated force up to the overlap `until`: there, unless the force falls before the reversal.
  double largest_force(double until) const;
  /// rms of raw/treated - 1 over 0.25 to 1 of the largest delta.
  double grid_noise() const { return grid_noise_; }

 private:
  void fit(const std::vector<const TraceSample*>& samples, double deepest);
  void measure_ripple(const std::vector<const TraceSample*>& samples, double deepest);

  std::vector<double> coefficients_;
  double from_ = 0, centre_ = 0, half_ = 1, grid_noise_ = 0;
};

/// Largest force of a mean trace, smoothed over 2 % of the loading's samples either way by a running
/// quadratic (Savitzky and Golay 1964): the body's ringing passes, the sample that sticks out (by 2.6 % once
/// in 500 impacts) does not. 0 of a trace that is shorter.
double smoothed_peak(std::span<const TraceSample> trace);

}  // namespace granulaw
