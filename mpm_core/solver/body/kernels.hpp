#pragma once

#include "solver/body/body.hpp"
#include "solver/material/cauchy_stress.hpp"

namespace granulaw {

/// Instruction sets the kernels are compiled for; the fastest one this processor has is taken at run time
/// (environment GRANULAW_ISA = generic | avx2 | avx512 overrides). Results differ between sets in the last
/// bits only (fused multiply-add).
enum class InstructionSet { generic, avx2, avx512 };
InstructionSet instruction_set();
const char* name_of(InstructionSet set);

/// Limit of the step for a deformed body: how far its omega_max^2 has grown.
///
/// Bodies of revolution: a point's own bound on omega^2, up to a factor common to all, is the sum of squared
/// gradients over its corners, over the smallest eigenvalue of F^T F in the plane of r and z.
///
/// Three dimensions: a plane wave sum_j kappa_j A_j over the grid, row j of A that of F^-1 over h_j, has the
/// frequency c |sum_j kappa_j A_j|: a cell's frequencies go with the largest eigenvalue of A A^T. Under
/// pressure it stiffens: squeezed to the volume J, a material of logarithmic strains has the longitudinal
/// modulus (M - K ln J)/lambda^2 along a stretch lambda, M = K + 4/3 G (its energy K/2 ln^2 J + G |dev ln|^2,
/// differentiated twice).
struct Growth
{
  /// Largest omega^2 of filled cells, 1.5 c^2 times that eigenvalue: inside a body quadratic splines with
  /// lumped masses admit |kappa|^2 up to 1.5 along an axis, 1.41 and 1.44 across. 0: not used.
  double filled_omega2;
  /// Largest growth of omega^2 of a cut piece: 1 + share (ratio - 1); ratio: the eigenvalue over its value at
  /// rest; share: SplineCells::step_share. Bodies of revolution: of the largest bound.
  double cut;
  double largest;       ///< the same of all cells; of filled ones the ratio
  double least_volume;  ///< smallest det F
};

/// The functions of a kind of grid.
struct Kernels
{
  /// Stress at every material point from the nodal displacements, plastic state updated, and the internal
  /// nodal forces (force on the node = minus the stress divergence). `updated`: masses, velocities and forces
  /// from the points.
  void (*points_to_grid)(Body& body);

  /// v_i += dt f_i / m_i
  void (*accelerate)(Body& body, double dt);

  /// u_i += dt v_i; `updated`: places, velocities and stresses of the points.
  void (*grid_to_points)(Body& body, double dt);

  /// Forces of the elastic response about the plastic state, which is kept: in double precision, of a body in
  /// single precision from the state that fetch_state() copies. Three dimensions: none where a node is held.
  void (*elastic_response)(Body& body);

  Growth (*growth)(const Body& body);

  /// Cauchy stress at every point, from the displacements and the plastic state as they stand, both of the
  /// same moment: after points_to_grid and before the next move. In double precision, which is that of a
  /// body in single precision after fetch_state().
  void (*stress)(Body& body, CauchyStress* points);

  /// x, y, z and a zero.
  void (*momentum)(const Body& body, double* sum);
};

/// Kernels of the instruction set that runs.
const Kernels& kernels(const Body& body);
const Kernels& kernels(const Body& body, InstructionSet set);

/// `updated` grid: stress and state of the points after the displacements of the last step, and nodal forces
/// of the stresses as they are.
struct PointKernels
{
  void (*update_stress)(Body& body);
  void (*force_of_stress)(Body& body);
};
const PointKernels& point_kernels();

namespace isa_generic {
extern const Kernels corner_kernels, cell_kernels;
extern const PointKernels point_kernels;
}  // namespace isa_generic
namespace isa_avx2 {
extern const Kernels corner_kernels, cell_kernels;
extern const PointKernels point_kernels;
}  // namespace isa_avx2
namespace isa_avx512 {
extern const Kernels corner_kernels, cell_kernels;
extern const PointKernels point_kernels;
}  // namespace isa_avx512

}  // namespace granulaw
