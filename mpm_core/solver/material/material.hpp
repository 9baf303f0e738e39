#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "base/scales.hpp"

namespace granulaw {

/// A hardening law, rate law or yield surface of solver/material by its name, with the values of its keys,
/// SI; lists of one for numbers. An empty name: none.
struct FlowLaw
{
  std::string name;
  std::map<std::string, std::vector<double>> values;
};

/// An elastic-plastic material, SI. Yield on the Cauchy stress, logarithmic elastic strain,
/// sigma_y = (yield_stress + hardening_modulus * equivalent plastic strain), or the flow stress that
/// `hardening` names, times the rate factor that `rate` names. sigma_y is that of uniaxial compression.
struct Material
{
  double density = 0;                                             ///< kg/m^3
  double youngs_modulus = 0;                                      ///< Pa
  double poisson_ratio = 0;                                       ///< 0 <= nu < 0.5
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Pa; infinity: elastic
  double hardening_modulus = 0;  ///< Pa, linear hardening d(sigma_y)/d(eps_p); 0: perfectly plastic
  FlowLaw hardening{};           ///< any other hardening law; hardening_modulus is then unused
  FlowLaw rate{};                ///< rate dependence of the yield stress
  FlowLaw yield_surface{};       ///< empty: von Mises
  double surface_energy = 0;     ///< J/m2, gamma of each surface: a pair has the work of adhesion 2 sqrt(gamma_a gamma_b)
  double adhesion_range = 0;     ///< m; 0: the usual one

  double e_star() const { return plane_strain_modulus(youngs_modulus, poisson_ratio); }
  /// The result then depends on R/c* against the time scale of the rate law: size invariance is lost.
  bool rate_dependent() const { return !rate.name.empty(); }
  bool yields() const { return yield_stress < std::numeric_limits<double>::infinity(); }
};

/// Throws Error (see base/error.hpp) naming `where` if a value cannot be used.
void validate(const Material& material, const char* where);

}  // namespace granulaw
