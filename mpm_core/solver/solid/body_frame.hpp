#pragma once

#include <memory>

#include "solver/particle/particle.hpp"
#include "solver/solid/solid.hpp"

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

}  // namespace granulaw
