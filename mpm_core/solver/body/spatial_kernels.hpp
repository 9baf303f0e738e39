#pragma once

#include "solver/material/cauchy_stress.hpp"
#include "solver/body/spatial_body.hpp"

namespace granulaw {

/// What the deformed cells allow for the step. A plane wave sum_j kappa_j A_j over the grid, row j of A that
/// of F^-1 over h_j, has the frequency c |sum_j kappa_j A_j|: a cell's frequencies go with the largest
/// eigenvalue of A A^T. Under pressure it stiffens: squeezed to the volume J, a material of logarithmic
/// strains has the longitudinal modulus (M - K ln J)/lambda^2 along a stretch lambda, M = K + 4/3 G (its
/// energy K/2 ln^2 J + G |dev ln|^2, differentiated twice).
struct CellGrowth
{
  /// Largest omega^2 of filled cells, 1.5 c^2 times that eigenvalue: inside a body quadratic splines with
  /// lumped masses admit |kappa|^2 up to 1.5 along an axis, 1.41 and 1.44 across.
  double filled_omega2;
  /// Largest growth of omega^2 of a cut piece: 1 + share (ratio - 1); ratio: the eigenvalue over its value at
  /// rest; share: SpatialBody::step_share_p.
  double cut;
  double largest;       ///< the same of all cells; of filled ones the ratio
  double least_volume;  ///< smallest det F
};

/// The kernels of three-dimensional bodies for one instruction set; see kernels.hpp.
struct SpatialKernels
{
  const char* name;

  /// Stress at every material point from the nodal displacements, plastic state updated, and the internal
  /// nodal forces. If `frozen`, the plastic state is left as it is and the response is elastic about it.
  void (*internal_force)(SpatialBody& body, bool frozen);

  /// v_i += dt f_i/m_i; symmetry planes hold their nodes.
  void (*accelerate)(SpatialBody& body, double dt);

  /// u_i += dt v_i
  void (*move)(SpatialBody& body, double dt);

  CellGrowth (*growth)(const SpatialBody& body);

  /// Cauchy stress at every lane, as in two dimensions.
  void (*stress)(SpatialBody& body, CauchyStress* points);

  /// x, y, z and a zero.
  void (*momentum)(const SpatialBody& body, double* sum);
};

const SpatialKernels& spatial_kernels();

namespace isa_generic {
extern const SpatialKernels spatial_kernels;
}
namespace isa_avx2 {
extern const SpatialKernels spatial_kernels;
}
namespace isa_avx512 {
extern const SpatialKernels spatial_kernels;
}

}  // namespace granulaw
