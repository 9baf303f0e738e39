#pragma once

#include <algorithm>
#include <cmath>

#include "contact/normal.hpp"

// The body behind a contact (docs/theory/body-behind.md): the law is of a sphere whose centre is its radius R away
// from the contact. In a body whose centre is L away, the field of the force goes on from R to L.
namespace granulaw {

/// k: under a force F on a half-space the point at depth z on its axis moves k F/(E* z) (Johnson 1985, eq. 3.19).
inline double far_field(double poisson_ratio)
{
  return (3.0 - 2.0 * poisson_ratio) / (2.0 * M_PI * (1.0 - poisson_ratio));
}

/// 1/m, what the field between R and L adds: 1/R - 1/L. Below L = R/2, in the hollow of a body, it stays: with
/// k (1/L - 1/R) 2 a < 1 force and overlap have one answer as long as the contact radius a is below R.
inline double reach_behind(double radius, double distance)
{
  return 1.0 / radius - 1.0 / std::max(distance, 0.5 * radius);
}

/// The overlap that the law has where the bodies behind it, of `compliance` c in m/N, take c F of the whole: the root
/// of x + c F(x) = overlap. `respond(x)` has force and stiffness of the law, `largest` its largest overlap so far.
double overlap_of_law(double overlap, double compliance, double largest, const auto& respond)
{
  if (compliance == 0.0) return overlap;
  // begins at the kink between loading and unloading, or beside it: Newton's steps then stay on one branch
  double x = largest > 0.0 ? std::min(overlap, largest) : overlap, low = 0.0, high = 2.0 * overlap;
  for (int step = 0; step < 60; ++step) {
    const auto now = respond(x);
    const double over = x + compliance * now.force - overlap;
    if (!(std::abs(over) > 1e-14 * overlap)) break;  // rounding of the sum
    (over > 0.0 ? high : low) = x;
    const double next = x - over / (1.0 + compliance * now.stiffness);
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}
/// The same of a contact that keeps its state.
template <NormalLaw Law>
double overlap_of_law(const Law& law, double r_eff, double overlap, double compliance, double* history)
{
  using State = NormalState<Law>;
  const double largest = State::largest(history), latched = State::impact_overlap(history);
  return overlap_of_law(overlap, compliance, largest, [&](double x) {
    return law.response(r_eff, x, largest, latched, history + State::own);
  });
}

/// J, elastic, in the bodies behind a contact of this force.
inline double energy_behind(double compliance, double force) { return 0.5 * compliance * force * force; }

}  // namespace granulaw
