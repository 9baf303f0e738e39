#pragma once

#include <cmath>

namespace granulaw {

/// Part of critical that models of the particle code damp by where nothing is said: contacts that never yielded, and
/// the tangential spring.
inline constexpr double usual_elastic_damping = 0.001, usual_shear_damping = 0.1;

/// ContactElement::damping for a part Z of critical: sqrt(5) Z sqrt(k m) d^(1/4) makes e = exp(-pi Z/sqrt(1 - Z^2)) at
/// every speed (Antypov & Elliott 2011); k = 4/3 E* sqrt(R*), stretched 1/S^2.5.
inline double elastic_dashpot(double ratio, double pair_modulus, double stretch)
{
  return std::sqrt(5.0) * ratio * std::sqrt(4.0 / 3.0 * pair_modulus) * std::pow(stretch, -1.25);
}

}  // namespace granulaw
