#pragma once

#include <limits>

namespace granulaw {

/// A rate-independent elastic-plastic material, SI. J2 yield on the Cauchy stress, logarithmic elastic strain,
/// sigma_y = yield_stress + hardening_modulus * equivalent plastic strain.
struct Material
{
  double density = 0;         ///< kg/m^3
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;   ///< 0 <= nu < 0.5
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Pa; infinity: elastic
  double hardening_modulus = 0;  ///< Pa, linear hardening d(sigma_y)/d(eps_p); 0: perfectly plastic

  double e_star() const { return youngs_modulus / (1.0 - poisson_ratio * poisson_ratio); }
  bool yields() const { return yield_stress < std::numeric_limits<double>::infinity(); }
};

/// Throws Error (see base/error.hpp) naming `where` if a value cannot be used.
void validate(const Material& material, const char* where);

/// A homogeneous sphere.
struct Sphere
{
  double radius = 0;  ///< m
  Material material;
};

}  // namespace granulaw
