#pragma once

#include "solver/body/body.hpp"
#include "solver/material/cauchy_stress.hpp"

namespace granulaw {

/// Instruction sets the kernels are compiled for; the fastest one this processor has is taken at run time
/// (environment GRANULAW_ISA = generic | avx2 | avx512 overrides). Results differ between sets in the last
/// bits only (fused multiply-add).
struct Kernels
{
  const char* name;

  /// Stress at every material point from the nodal displacements, plastic state updated, and the internal
  /// nodal forces fr_i, fz_i (force on the node = minus the stress divergence). If `frozen`, the plastic
  /// state is left as it is and the response is elastic about it (power iteration). Frozen responses are in
  /// double: of a body in single precision from the state that fetch_state() copies.
  /// On the `updated` grid the displacements are those of the last step, and forces are those of the
  /// configuration before it: only the power iteration asks for them.
  void (*internal_force)(Body& body, bool frozen);

  /// `updated` grid: stress and state of the points after the displacements of the last step. No forces.
  void (*update_stress)(Body& body);

  /// `updated` grid: nodal forces of the stresses as they are, with the weights as they are.
  void (*force_of_stress)(Body& body);

  /// v_i += dt f_i / m_i
  void (*accelerate)(Body& body, double dt);

  /// u_i += dt v_i
  void (*move)(Body& body, double dt);

  /// Cauchy stress at every point, from the displacements and the plastic state as they stand, both of the
  /// same moment: after internal_force and before the next move. In double precision, which is that of a
  /// body in single precision after fetch_state().
  void (*stress)(Body& body, CauchyStress* points);

  /// Along +z.
  double (*momentum)(const Body& body);

  /// Largest over the points of the cell's own bound on omega^2, up to a factor common to all cells: the sum
  /// of squared gradients over the corners, over the smallest eigenvalue of F^T F in the plane of r and z.
  double (*growth)(const Body& body);
};

const Kernels& kernels();

namespace isa_generic {
extern const Kernels kernels;
}
namespace isa_avx2 {
extern const Kernels kernels;
}
namespace isa_avx512 {
extern const Kernels kernels;
}

}  // namespace granulaw
