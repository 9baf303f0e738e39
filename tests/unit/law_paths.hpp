#pragma once

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"
#include "contact/contact.hpp"

// Properties of a law on a path of one contact.
namespace granulaw::tests {

/// Force unit 1, length unit 1: answer() then returns the curve's own numbers.
inline const PairMapping unit_pair = PairMapping::rigid_partner(0.75);

/// Draws a reversal, also beyond the table, and an overlap below or beyond it; asserts that the stiffness
/// there is the derivative of the force.
inline void stiffness_is_the_derivative(const Curve& curve, double impact_overlap = 0)
{
  const double x_m = curve.end() * std::pow(*rc::gen::inRange(1, 1150) / 1000.0, 4);
  const double x = x_m * *rc::gen::inRange(1, 2000) / 1000.0, step = 1e-7 * x;
  RC_PRE(std::abs(x - x_m) > 2 * step && std::abs(x - curve.end()) > 2 * step);
  const auto at = [&](double overlap) { return answer(curve, unit_pair, 1.0, overlap, x_m, impact_overlap); };
  const Answer here = at(x);
  const double up = at(x + step).force, down = at(x - step).force;
  RC_PRE((up == 0) == (down == 0));
  // central difference: truncation 1e-14, cancellation 1e-16/1e-7 of F/x; up to 1e-7 times some where a
  // node's jump in F'' is crossed
  RC_ASSERT(std::abs((up - down) / (2 * step) - here.stiffness) <= 1e-6 * (here.stiffness + here.force / x));
}

/// A path of a contact that latched X, and the work put into it, by Simpson's rule in s = x^(1/4).
class Path
{
 public:
  explicit Path(const Curve& law, double impact_overlap = 0) : law_(&law), impact_overlap_(impact_overlap) {}

  void move(double to)
  {
    // Not across where the force ends, nor the reversal: it has kinks there.
    if ((force(x_) > 0) != (force(std::min(to, x_m_)) > 0)) piece(end_of_force(x_, std::min(to, x_m_)));
    if (x_ < x_m_ && to > x_m_) piece(x_m_);
    piece(to);
    x_m_ = larger(x_m_, to);
  }
  double x() const { return x_; }
  double x_m() const { return x_m_; }
  double work() const { return work_; }
  /// Largest force met, times x_m: above all work.
  double scale() const { return top_ * x_m_; }
  /// Error of Simpson's rule in the work: its change with half as many pieces, and rounding.
  double open() const { return open_ + 1e-12 * scale(); }

 private:
  double force(double x) const
  {
    return x > 0 ? answer(*law_, unit_pair, 1.0, x, x_m_, impact_overlap_).force : 0.0;
  }
  /// Between two overlaps, one with force and one without.
  double end_of_force(double a, double b) const
  {
    const bool at_a = force(a) > 0;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (a + b);
      ((force(middle) > 0) == at_a ? a : b) = middle;
    }
    return a;
  }
  void piece(double to)
  {
    constexpr int pieces = 1000;
    const double a = std::pow(x_, 0.25), h = (std::pow(to, 0.25) - a) / pieces;
    const auto integrand = [&](double s) {
      const double x = s * s * s * s;
      const double f = force(x);
      RC_ASSERT(f >= 0 && std::isfinite(f));
      top_ = larger(top_, f);
      return 4 * s * s * s * f;
    };
    double fine = 0, coarse = 0, first = integrand(a);
    for (int k = 0; k < pieces; k += 2) {
      const double middle = integrand(a + (k + 1) * h), last = integrand(a + (k + 2) * h);
      fine +=
          h / 6 *
          (first + 4 * integrand(a + (k + 0.5) * h) + 2 * middle + 4 * integrand(a + (k + 1.5) * h) + last);
      coarse += h / 3 * (first + 4 * middle + last);
      first = last;
    }
    work_ += fine;
    open_ += std::abs(fine - coarse);
    x_ = to;
  }

  const Curve* law_;
  double impact_overlap_;
  double x_ = 0, x_m_ = 0, work_ = 0, open_ = 0, top_ = 0;
};

/// Draws reversals of a contact; asserts that no closed cycle gains energy by more than `error` of the force
/// allows.
inline void no_closed_cycle_gains(const Curve& curve, double impact_overlap = 0, double error = 0)
{
  const auto any_overlap = [&] {  // a little beyond the table, too
    return curve.end() * std::pow(*rc::gen::inRange(1, 1020) / 1000.0, 4);
  };
  // the force's error on the way up and down, over no longer way than x_m
  const auto open = [&](const Path& path) { return 2 * error * path.scale() + path.open(); };
  Path contact(curve, impact_overlap);
  const int turns = *rc::gen::inRange(2, 10);
  for (int k = 0; k < turns; ++k) contact.move(any_overlap());
  // a cycle that begins anywhere: to come back from it leaves no less spent than to come back at once
  Path cycled = contact;
  for (int k = 0; k < 3; ++k) cycled.move(any_overlap());
  cycled.move(contact.x());
  cycled.move(0.0);
  contact.move(0.0);
  RC_ASSERT(contact.work() >= -open(contact));
  RC_ASSERT(cycled.work() - contact.work() >= -open(cycled));
  // unloading and reloading share a curve: without a new delta_max nothing is gained or lost
  Path again = contact;
  for (int k = 0; k < 3; ++k) again.move(contact.x_m() * *rc::gen::inRange(0, 1001) / 1000.0);
  again.move(0.0);
  RC_ASSERT(std::abs(again.work() - contact.work()) <= open(again));
}

}  // namespace granulaw::tests
