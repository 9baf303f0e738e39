#pragma once

#include "solver/material/flow_trials.hpp"
#include "solver/material/moduli.hpp"

namespace granulaw::kernel {

/// Flow of a material for one precision, chosen once for each region.
template <class Real>
struct Yielding
{
  /// Fills what the points of a block flow; whether any does. Null: elastic.
  bool (*find)(FlowTrials<Real>&, int count, const Real* plastic_strain, const Moduli&,
               const FlowStress<Real>&, double per_dt);
  FlowStress<Real> flow_stress;
  bool dilates;    ///< the flow changes the volume
  bool has_state;  ///< there may be a plastic state
};

}  // namespace granulaw::kernel

namespace granulaw::GRANULAW_ISA_NAMESPACE {

/// Yielding of a material: compiled apart from the tensors, once for each instruction set (yielding_isa.cpp).
kernel::Yielding<double> yielding_in_double(const Moduli& moduli);
kernel::Yielding<float> yielding_in_float(const Moduli& moduli);

}  // namespace granulaw::GRANULAW_ISA_NAMESPACE
