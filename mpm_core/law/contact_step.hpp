#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/larger.hpp"
#include "law/law.hpp"
#include "contact/thornton.hpp"

// The time step of a particle code: one rule for the plug-in, `mpm plan` and `mpm soften`.
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

/// Stiffness of the steeper branch at x = delta/(lambda R*) of a contact that has just reached it, over Hertz's
/// force at x = 1 and the length lambda R*.
inline double reversal_stiffness(const Curve& curve, double x, double impact_overlap = 0)
{
  const double loading = curve.loading(x, impact_overlap).stiffness;
  if (x <= curve.onset()) return loading;
  return std::max(loading, curve.reversal(x, impact_overlap).stiffness(x));
}

/// The same before a run: of a contact pressed to x, or of an impact that reverses there, whichever is stiffer.
inline double planned_stiffness(const Curve& curve, double x)
{
  const double pressed = reversal_stiffness(curve, x);
  const AxisTable* axis = curve.axis();
  if (!axis) return pressed;
  const double impact_overlap =
      std::clamp(x, curve.reach(axis->speed_begin), curve.reach(axis->speed_end));
  return std::max(pressed, reversal_stiffness(curve, x, impact_overlap));
}

/// The same of a pair, N/m, at the overlap `delta` (m).
inline double planned_stiffness(const PairLaw& law, double r_eff, double delta)
{
  const double length = law.mapping.length(r_eff);
  return law.mapping.force(r_eff) / length * planned_stiffness(*law.curve, delta / length);
}

inline double planned_stiffness(const ThorntonPair& law, double r_eff, double delta)
{
  return std::max(law.evaluate(r_eff, delta, delta).stiffness, law.unloading_stiffness(r_eff, delta));
}

}  // namespace granulaw
