#pragma once

#include "base/attraction.hpp"
#include "contact/adhesion.hpp"
#include "option_checks.hpp"
#include "options.hpp"

namespace granulaw {

/// --work-of-adhesion and --adhesion-range.
inline void define_adhesion(Options& command, Attraction& attraction)
{
  attraction.range = usual_adhesion_range;
  const Option work = command.add_option("--work-of-adhesion", attraction.work, "J/m2, of the pair of surfaces, 2 sqrt(gamma_a gamma_b) (default: no adhesion)").check(above_zero_to(1e3));
  command.add_option("--adhesion-range", attraction.range, "m, gap at which the attraction ends (default 0.4e-9, of smooth clean surfaces)").check(above_zero_to(1e-3)).needs(work);
}

}  // namespace granulaw
