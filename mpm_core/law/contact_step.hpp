#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/larger.hpp"
#include "contact/tabulated.hpp"
#include "contact/thornton.hpp"
#include "law/law.hpp"

// The time step of a particle code: one rule for the plug-in, `mpm plan` and `mpm stretch`.
//
// The largest step is a twentieth of the period 2 pi sqrt(m*/k) of the stiffest contact at the overlaps that are
// reached: planned ones before a run, visited ones in it. k is the slope of the steeper branch, further in or
// back out, as unloading is the stiffest part of a contact that yielded. What it costs:
// docs/reference/fix_granulaw_stats.md, "Time step".
namespace granulaw {

/// Part of the stiffest contact's period that a step may take.
inline constexpr double step_fraction = 1.0 / 20.0;

/// The largest step, s, of a contact of this effective mass (kg) and stiffness (N/m); in any consistent units.
inline double largest_step(double m_eff, double stiffness)
{
  return step_fraction * 2.0 * M_PI * std::sqrt(m_eff / stiffness);
}

/// The largest step, s, of a contact that goes as deep as `overlap`. `stiffness(delta)`: of the stiffest that a
/// contact is which has just reached delta. It varies slowly, but need not be largest at the end.
double largest_step_to(double overlap, double m_eff, const auto& stiffness)
{
  constexpr int samples = 64;
  double hardest = 0;
  for (int k = 1; k <= samples; ++k) hardest = larger(hardest, stiffness(overlap * k / samples));
  return largest_step(m_eff, hardest);
}

/// The overlap up to which `step` is short enough, to 1e-6 of `deepest`, and no deeper than that.
double overlap_of_step(double step, double m_eff, double deepest, const auto& stiffness)
{
  if (largest_step_to(deepest, m_eff, stiffness) >= step) return deepest;
  double low = 0, high = deepest;
  while (high - low > 1e-6 * deepest) {
    const double middle = 0.5 * (low + high);
    (largest_step_to(middle, m_eff, stiffness) >= step ? low : high) = middle;
  }
  return low;
}

/// N/m: of the steeper branch of a pair that has just reached `delta` (m), before a run.
inline double planned_stiffness(const PairLaw& law, double r_eff, double delta)
{
  const double length = law.mapping.length(r_eff);
  return law.mapping.force(r_eff) / length * planned_stiffness(*law.curve, delta / length);
}

}  // namespace granulaw
