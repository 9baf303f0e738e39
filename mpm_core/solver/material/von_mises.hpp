#pragma once

#include <array>

#include "solver/material/parameter.hpp"
#include "solver/material/flow_trials.hpp"

namespace granulaw::flow {

/// Von Mises (1913): q <= J sigma_y on the Kirchhoff stress, that is on the Cauchy stress tau/J.
struct VonMises
{
  static constexpr const char* name = "von-mises";
  static constexpr std::array<Parameter, 0> parameters{};

  static GRANULAW_MEMBER VonMises from(const double*) { return {}; }
  GRANULAW_MEMBER bool dilates() const { return false; }
  template <class Real>
  GRANULAW_MEMBER bool find(kernel::FlowTrials<Real>& trials, int count, const Real* plastic_strain,
                            const Moduli& m, double shear, double /*bulk*/,
                            const kernel::FlowStress<Real>& flow_stress, double per_dt) const
  {
    return flow_stress.find(trials, trials.q, count, plastic_strain, m, 1.0, 3.0 * shear, per_dt);
  }
};

}  // namespace granulaw::flow
