#pragma once

#include "solver/spatial/spatial_body.hpp"

namespace granulaw {

/// How far the cells of a body are from their reference shape.
struct CellGrowth
{
  /// largest of sum_j |row j of F^-1|^2/h_j^2, the cell's own bound on omega^2 but for a common factor
  double bound;
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
