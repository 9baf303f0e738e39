#pragma once

#include <cmath>
#include <limits>

#include "contact/normal.hpp"
#include "law/contact_step.hpp"

// Limits of a contact of one R* and m*, the same for the plug-in's start-up table and the interactive page. All in
// the units of the law.
namespace granulaw {

/// m/s, approach speed from which the contact yields; infinity: not within the law.
template <NormalLaw Law>
double onset_speed(const Law& law, double r_eff, double m_eff)
{
  if (!(law.yield_overlap() < law.largest_overlap())) return std::numeric_limits<double>::infinity();
  const double onset = law.yield_overlap() * r_eff;
  return std::sqrt(2.0 * law.stored_energy(r_eff, onset, onset, 0.0) / m_eff);
}

/// N/m, stiffness that the time step is planned for: of a contact that has just reached `delta` (m).
template <NormalLaw Law>
double step_stiffness(const Law& law, double r_eff, double delta)
{
  if constexpr (requires { law.planned_stiffness(r_eff, delta); })
    return law.planned_stiffness(r_eff, delta);
  else
    return law.stiffness(r_eff, delta, 0.0);
}

/// s, largest time step that is short enough for the whole range of the law.
template <NormalLaw Law>
double largest_step_of(const Law& law, double r_eff, double m_eff)
{
  return largest_step_to(law.stiffness_range() * r_eff, m_eff,
                         [&](double delta) { return step_stiffness(law, r_eff, delta); });
}

}  // namespace granulaw
