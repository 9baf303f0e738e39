#pragma once

#include <span>
#include <vector>

#include "contact/cubic.hpp"

namespace granulaw {

/// A cubic spline over equal intervals of [0, end] that leaves 0 with zero value and slope: all that plasticity
/// adds to the elastic law begins so at first yield. Below 0 it is 0, beyond its end it goes on straight.
class Spline
{
 public:
  struct Sample
  {
    double q, value, weight;
  };

  /// 0 everywhere.
  Spline() = default;
  /// Through values, five or more, at even places from 0 to `end`; the first is 0.
  static Spline through(std::vector<double> values, double end);
  /// Weighted least squares through 2 samples or more. The penalty on the differences of this order of the
  /// B-spline coefficients is `stiffness` times the mean weight of the samples: it bridges intervals without
  /// samples and does not follow grid noise.
  static Spline fit(std::span<const Sample> samples, double end, int intervals, double stiffness,
                    int order = 3);

  double value(double q) const;
  double slope(double q) const;
  /// At this many even places from 0 to the end.
  std::vector<double> values(std::size_t places) const;

 private:
  Spline(HermiteColumn nodes, double end) : nodes_(std::move(nodes)), end_(end) {}
  double spacing() const { return end_ / static_cast<double>(nodes_.size() - 1); }
  struct Place
  {
    double c[4], t;
  };
  Place place(double q) const;

  HermiteColumn nodes_{{0, 0}, {0, 0}};
  double end_ = 1;
};

}  // namespace granulaw
