#pragma once

#include "solver/body/body.hpp"

namespace granulaw {

/// Points of an `updated` grid to the grid: weights at the points' places, nodal masses and velocities,
/// forces of the points' stresses.
void updated_points_to_grid(Body& body);

/// Grid to points, after u_i += dt v_i: velocities, affine velocities, places, stresses.
void updated_grid_to_points(Body& body, double dt);

}  // namespace granulaw
