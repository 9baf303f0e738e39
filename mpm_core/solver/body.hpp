#pragma once

#include <vector>

#include "solver/flow/laws.hpp"
#include "solver/mapped_grid.hpp"
#include "solver/material.hpp"

namespace granulaw {

/// Elastic-plastic constants in solver units (stress / E*).
struct Moduli
{
  double shear;      ///< G
  double bulk;       ///< K
  double yield;      ///< Y
  double hardening;  ///< H
  bool yields;       ///< false: elastic, Y and H unused
  flow::Flow
      flow{};  ///< hardening and rate laws; the default is Y + H ep, which reads `yield` and `hardening`
};

/// A body on its reference grid, structure of arrays, solver units (R = rho = E* = 1).
/// Material-point fields end in _p (one point a cell), grid fields in _i, as in the MPM literature.
///
/// Total Lagrangian: the weights b_p = mean gradient of the shape functions are computed once on the
/// reference grid, with r dA as measure, so that a linear displacement field and a uniform pressure are exact
/// (the patch test of Flanagan and Belytschko 1981, axisymmetric). With one point a cell and persistent nodal
/// velocities the method is, in the limit, an explicit finite element method: said plainly in the docs.
struct Body
{
  // reference grid
  int nodes = 0, points = 0;
  std::vector<double> r_i, z_i;  ///< reference coordinates
  std::vector<double> mass_i, inverse_mass_i;
  std::vector<double> ur_i, uz_i;  ///< displacements (never positions: keeps small strains exact)
  std::vector<double> vr_i, vz_i;
  std::vector<double> fr_i, fz_i;  ///< internal force
  std::vector<int> surface, axis, equator;
  double mass = 0;

  // material points, [4 corners][points] flattened as corner * points + p
  std::vector<int> corner_p;             ///< node of each corner
  std::vector<double> br_p, bz_p, bh_p;  ///< d/dr, d/dz and hoop (N/r) weights
  std::vector<double> hourglass_p;       ///< hourglass shape vector gamma
  std::vector<double> volume_p;          ///< reference volume, full revolution
  std::vector<double> stiffness_p;       ///< hourglass stiffness
  // state: inverse plastic right Cauchy-Green tensor minus identity, and equivalent plastic strain
  std::vector<double> crr_p, czz_p, crz_p, chh_p, plastic_strain_p;
  std::vector<double> plastic_work_p;    ///< dissipated, per point
  std::vector<double> elastic_energy_p;  ///< stored, per point, written with every force evaluation
  // corner forces of each point, summed to the nodes by node_slots; the last entry is a zero
  std::vector<double> corner_fr, corner_fz;
  std::vector<int> node_slots;  ///< [4][nodes] positions in corner_f*; unused ones point at the zero

  double elapsed =
      0;  ///< time since the plastic state was last updated: `move` adds, internal_force empties it

  Moduli moduli{};

  static Body build(const MappedGrid& grid, const Moduli& moduli, double hourglass_modulus);

  double kinetic_energy() const;
  double strain_energy() const;  ///< elastic and hourglass energy at the last force evaluation
  double plastic_work() const;
  /// Velocity of the centre of mass along +z.
  double mean_velocity() const;
};

}  // namespace granulaw
