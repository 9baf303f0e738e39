#pragma once

#include <limits>
#include <string>

#include "base/scales.hpp"
#include "contact/contact.hpp"

namespace granulaw {

/// A material as the law file keeps it, SI. `yield_stress` infinite: elastic.
struct LawMaterial
{
  std::string name;
  double density = 0;         ///< kg/m^3
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Pa
  double hardening_modulus = 0;  ///< Pa, d(yield stress)/d(equivalent plastic strain); 0: perfectly plastic
  FlowNodes flow{};              ///< of hardening that is not linear; no nodes: it is, or is not known

  double e_star() const { return plane_strain_modulus(youngs_modulus, poisson_ratio); }
  /// Pa. It refers to `flow`.
  FlowStress flow_stress() const { return {yield_stress, hardening_modulus, flow.strain.empty() ? nullptr : &flow}; }
  bool yields() const { return yield_stress < std::numeric_limits<double>::infinity(); }
};

}  // namespace granulaw
