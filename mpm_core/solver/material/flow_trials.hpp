#pragma once

namespace granulaw {
struct Moduli;
}

namespace granulaw::kernel {

constexpr int block_points = 64;

/// Points of a block as their yield function has them: no tensor, no dimension. Kirchhoff stresses.
template <class Real>
struct alignas(64) FlowTrials
{
  // in: with all plastic flow of the step undone
  Real q[block_points];         ///< von Mises' equivalent
  Real jacobian[block_points];  ///< J = det F
  Real trace[block_points];     ///< of the elastic logarithmic strain; bulk * trace: mean stress
  Real trial[block_points];     ///< room for a yield surface's own measure of stress
  // out: the flow of the step
  Real strain[block_points];    ///< increment of the equivalent plastic strain; takes 3 G times it from q
  Real stress[block_points];    ///< mean q meanwhile; stress * strain is work
  Real dilation[block_points];  ///< of what dilates: plastic volume strain, taken from the trace
};

/// Flow stress of a material, hardening times rate, as its yield surface uses it.
template <class Real>
struct FlowStress
{
  /// find_flow (flow_stress.hpp) with `scale` times the flow stress.
  bool (*find)(FlowTrials<Real>&, const Real* trial, int count, const Real* plastic_strain, const Moduli&,
               double scale, double stiffness, double per_dt);
  /// At one equivalent plastic strain and its rate.
  double (*at)(const Moduli&, double plastic_strain, double rate);
};

}  // namespace granulaw::kernel
