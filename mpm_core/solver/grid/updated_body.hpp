#pragma once

#include "solver/grid/rectilinear_body.hpp"

namespace granulaw {

/// The same section on a rectilinear grid that stays where it is while the points move through it:
/// updated-Lagrangian material point method with affine velocities (APIC: Jiang, Schroeder, Selle, Teran and
/// Stomakhin 2015), quadratic B-splines and surface markers. The independent check of the other two grids,
/// and nearest to the method of Li, Pan and Sinka (2009).
Body updated_body(const CutSection& section);

}  // namespace granulaw
