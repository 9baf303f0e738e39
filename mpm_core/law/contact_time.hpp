#pragma once

#include <cmath>

namespace granulaw {

/// Hertz's contact time 2.87 (m*^2/(E*^2 R* V))^(1/5), s, with Johnson's factor of three digits; a plastic contact takes a
/// few times as long at most. Steps and durations of replays are counted in it.
inline double customary_contact_time(double e_star, double r_eff, double effective_mass, double velocity)
{
  return 2.87 * std::pow(effective_mass * effective_mass / (e_star * e_star * r_eff * velocity), 0.2);
}

}  // namespace granulaw
