#pragma once

#include <Eigen/Core>

#include "solver/body/spatial_body.hpp"

namespace granulaw {

using Vector3 = Eigen::Vector3d;

// A three-dimensional body as a rigid one sees it. Momenta are those of the part that is computed.

/// Of a node in the undeformed body, and where it is now.
Vector3 reference_place(const SpatialBody& body, int node);
Vector3 place_now(const SpatialBody& body, int node);

/// Gives the body at rest a rigid motion: `velocity` of the point `centre` and a rotation about it.
void throw_body(SpatialBody& body, const Vector3& velocity, const Vector3& spin, const Vector3& centre);

Vector3 momentum(const SpatialBody& body);
/// Of the centre of mass of the whole body.
Vector3 mean_velocity(const SpatialBody& body);
Vector3 angular_momentum(const SpatialBody& body, const Vector3& centre);
/// The whole body's angular momentum from that of the part that is computed: mirrored parts cancel all but
/// the component along a mirror's normal.
Vector3 of_whole(const SpatialBody& body, Vector3 angular);

}  // namespace granulaw
