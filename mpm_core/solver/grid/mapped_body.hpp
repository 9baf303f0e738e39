#pragma once

#include <functional>
#include <vector>

#include "solver/body/body.hpp"
#include "solver/grid/mapped_grid.hpp"

namespace granulaw {

/// Body of one material on a grid fitted to it: one point a cell, four corners, hourglass control in total
/// form with the modulus `hourglass_modulus`. With one point a cell and persistent nodal velocities the
/// method is, in the limit, an explicit finite element method: said plainly in the docs. Masses are scaled to
/// the exact volume (chords of the surface cells cut a little off).
Body mapped_body(const MappedGrid& grid, const Phase& phase, double hourglass_modulus);

}  // namespace granulaw
