#pragma once

#include <vector>

#include "solver/body.hpp"

namespace granulaw {

/// Cauchy stress of an axisymmetric body, tension positive; h: hoop.
struct CauchyStress
{
  double rr, zz, rz, hh;

  double pressure() const { return -(rr + zz + hh) / 3; }  ///< compression positive
  double von_mises() const;
};

/// Cauchy stress at every material point, solver units (E*), from the displacements and the plastic state as
/// they stand, both of the same moment: after internal_force and before the next move. Same equations as the
/// kernel (kernels_isa.cpp), which stores no stress; written for reading, not for speed.
std::vector<CauchyStress> cauchy_stress(const Body& body);

/// The same at the end of a step, where the displacements have moved on: the plastic state is brought up to
/// them in a copy. `body` and the run that owns it are not touched.
struct PointState
{
  std::vector<CauchyStress> stress;
  std::vector<double> plastic_strain;
};
PointState point_state_now(const Body& body);

}  // namespace granulaw
