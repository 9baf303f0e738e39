#pragma once

#include <memory>

#include "solver/shape/particle.hpp"
#include "solver/shape/solid.hpp"

namespace granulaw {

/// The particle's surface in three dimensions. A particle that is no solid lies about the z axis with its
/// middle in the origin, so that its contact pole is (0, 0, -height/2).
std::shared_ptr<const Solid> solid_of(const Particle& particle);

/// The particle's material at a point of depth `depth` in the frame of solid_of(particle): index into its
/// materials, -1: outside the body or in a pore.
int material_at(const Particle& particle, const Vector3& x, double depth);

/// True if a point of the body is deeper than `depth`, m. May miss one whose depth is larger by less than 1
/// %.
bool is_deeper_than(const Solid& solid, double depth);

/// Rotation from the body's frame to that of a wall with the normal +z: it turns the unit vector `direction`
/// of the body to -z. The axis of the body nearest to it leans towards +x; where it lies along an axis, the
/// next axis of the body becomes x.
Eigen::Matrix3d rotation_to_plane(const Vector3& direction, double turn = 0);
/// The turn, rad, with which the unit vector `tangent` of the body, at right angles to `direction`, becomes
/// +x.
double turn_along(const Vector3& direction, const Vector3& tangent);

}  // namespace granulaw
