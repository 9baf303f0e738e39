#pragma once

/// Residuals of identities that hold to rounding on every grid (asserted in identities_test.cpp).
namespace granulaw::verification {

struct Identities
{
  double patch;        ///< a linear displacement field: largest relative deviation of a cell's stored energy
  double equilibrium;  ///< uniform pressure: largest force on an inner node over the largest on the surface
  double momentum;  ///< random displacements: sum of the axial internal forces over that of their magnitudes
  double mass;      ///< relative deviation of the sphere's mass
};
Identities identities(int cells_across);

}  // namespace granulaw::verification
