#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "contact/cubic.hpp"

namespace granulaw {

/// A cubic spline over equal intervals of [0, end] that leaves 0 with zero value and slope: all that plasticity
/// adds to the elastic law begins so at first yield. Below 0 it is 0, beyond its end it goes on straight.
class Spline
{
 public:
  /// 0 everywhere.
  Spline() = default;
  /// Through values, five or more, at even places from 0 to `end`; the first is 0.
  static Spline through(std::vector<double> values, double end);
  /// Values and slopes at even places from 0 to `end`; the first are 0.
  Spline(HermiteColumn nodes, double end) : nodes_(std::move(nodes)), end_(end) {}

  double value(double q) const;
  double slope(double q) const;
  /// At this many even places from 0 to the end.
  std::vector<double> values(std::size_t places) const;

 private:
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
