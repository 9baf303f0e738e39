#pragma once

#include <optional>
#include <vector>

#include "solver/body/spline_axis.hpp"
#include "solver/material/material.hpp"
#include "solver/material/moduli.hpp"

namespace granulaw {

class StateArchive;

/// What the material points carry, structure of arrays; fields end in _p.
/// Corner fields are flattened as corner * points + p: a point has `corners` grid nodes it exchanges with.
template <class Real>
struct PointArrays
{
  std::vector<Real> br_p, bz_p, bh_p;  ///< d/dr, d/dz and hoop (N/r) weights of each corner
  std::vector<Real> hourglass_p;       ///< four corners: hourglass shape vector gamma
  std::vector<Real> stiffness_p;       ///< four corners: hourglass stiffness
  std::vector<Real> volume_p;          ///< reference volume, full revolution
  /// state: inverse plastic right Cauchy-Green tensor minus identity (`updated`: elastic left Cauchy-Green
  /// tensor minus identity), and equivalent plastic strain
  std::vector<Real> crr_p, czz_p, crz_p, chh_p, plastic_strain_p;
  std::vector<Real> plastic_work_p;    ///< dissipated, per point
  std::vector<Real> elastic_energy_p;  ///< stored, per point, written with every stress evaluation
  /// corner forces of each point, summed to the nodes by node_slots; the last entry is a zero
  std::vector<Real> corner_fr, corner_fz;
};

/// Points of the one material that lie in [begin, end).
struct Region
{
  int begin, end;
  Moduli moduli;
  int material = 0;  ///< index in the particle's list
};

/// Points of the true surface that can come into contact, from the contact pole outwards, and the grid nodes
/// they move with. On a grid fitted to the body these are the surface nodes themselves (one corner).
struct Surface
{
  int count = 0, corners = 0;
  std::vector<int> node;       ///< [corners][count]
  std::vector<double> weight;  ///< [corners][count]
  std::vector<double> r, z;    ///< reference coordinates (`updated`: coordinates now)
};

/// The points of a body on the `updated` grid, which move through it (updated_body.hpp).
struct MovingPoints
{
  SplineAxis r_axis, z_axis;
  std::vector<double> r, z;  ///< where they are
  std::vector<double> mass;
  std::vector<double> vr, vz;              ///< velocity
  std::vector<double> crr, crz, czr, czz;  ///< affine velocity: gradient of v about the point (APIC)
  std::vector<double> trr, tzz, trz, thh;  ///< Kirchhoff stress
};

/// A body on its grid, structure of arrays, solver units (R = rho = E* = 1), in its own frame: contact pole
/// at the origin, body in z >= 0. Material-point fields end in _p, grid fields in _i, as in the MPM
/// literature.
///
/// Total Lagrangian (`mapped`, `rectilinear`): weights are computed once on the reference grid, nodal
/// displacements are kept. The weights of a point are the mean gradients of the shape functions over the
/// piece of the body that it stands for, with r dA as measure, so that linear displacement fields and uniform
/// pressure are exact (Flanagan and Belytschko 1981, axisymmetric). `updated`: weights follow the points in
/// every step (updated_body.hpp) and the nodal displacements are those of the last step only.
struct Body : PointArrays<double>
{
  // grid
  int nodes = 0;
  std::vector<double> r_i, z_i;  ///< reference coordinates
  std::vector<double> mass_i, inverse_mass_i;
  std::vector<double> ur_i, uz_i;  ///< displacements (never positions: keeps small strains exact)
  std::vector<double> vr_i, vz_i;
  std::vector<double> fr_i, fz_i;  ///< internal force
  std::vector<int> axis, equator;  ///< nodes on the axis; nodes of the plane driven under midplane support
  std::vector<char> on_axis;       ///< per node
  Surface surface;
  Surface pore_walls;  ///< `rectilinear`: pairs of places on opposite walls of a pore, one after the other
  Surface outline;     ///< `rectilinear`: corners of the piece that each point stands for, [4][points]; for
                       ///< looking at
  double mass = 0;
  double travel = 0;  ///< displacement of the centre of mass along +z, integrated from the momentum

  // material points
  int points = 0, corners = 0;
  std::vector<int> corner_p;    ///< node of each corner
  std::vector<Region> regions;  ///< by material, in the order of the points
  int slots = 0;                ///< most corners that meet in a node, rounded up to a multiple of 4
  std::vector<int> node_slots;  ///< [slots][nodes] positions in corner_f*; unused ones point at the zero
  /// time since the plastic state was last updated: `move` adds, internal_force empties it
  double elapsed = 0;

  /// Single precision: weights and state of the points in float, used instead of the double ones where
  /// filled. Nodes stay double, and so do the equations of flow laws without a closed form. Not on the
  /// `updated` grid. `fetch_state` copies the state back.
  PointArrays<float> single;
  bool is_single() const { return !single.br_p.empty(); }
  void use_single();
  void fetch_state();

  std::optional<MovingPoints> moving;  ///< on the `updated` grid only

  void allocate(int node_count, int point_count, int corner_count);
  /// Fills node_slots, axis flags and inverse masses once corners and masses stand.
  void link();

  /// Gives the body at rest the velocity `vz`.
  void throw_along(double vz);

  double kinetic_energy() const;
  double strain_energy() const;  ///< elastic and hourglass energy at the last stress evaluation
  /// Part of the strain energy: what the hourglass control holds at the displacements now.
  double hourglass_energy() const;
  double plastic_work() const;
  double largest_plastic_strain() const;
  /// Velocity of the centre of mass along +z.
  double mean_velocity() const;

  /// What changes from step to step, and the reference grid as a thing to agree upon (state_archive.hpp).
  void visit_state(StateArchive& archive);
};

}  // namespace granulaw
