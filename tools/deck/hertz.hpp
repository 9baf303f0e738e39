#pragma once

#include <cmath>

namespace granulaw::deck {

/// Largest overlap, m, of Hertz's collision of m* at `speed`: 1/2 m* V^2 = 8/15 E* sqrt(R*) delta^2.5.
inline double hertz_overlap(double e_star, double r_eff, double m_eff, double speed)
{
  return std::pow(15.0 / 16.0 * m_eff * speed * speed / (e_star * std::sqrt(r_eff)), 0.4);
}

/// Its duration, s (K. L. Johnson, Contact Mechanics, 11.24).
inline double hertz_time(double e_star, double r_eff, double m_eff, double speed) { return 2.9432 * hertz_overlap(e_star, r_eff, m_eff, speed) / speed; }

/// N/m, at this overlap.
inline double hertz_stiffness(double e_star, double r_eff, double overlap) { return 2 * e_star * std::sqrt(r_eff * overlap); }

}  // namespace granulaw::deck
