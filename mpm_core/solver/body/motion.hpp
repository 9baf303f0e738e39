#pragma once

#include <Eigen/Core>

#include "solver/body/body.hpp"

namespace granulaw {

using Vector3 = Eigen::Vector3d;

// A body as a rigid one sees it. Momenta are those of the part that is computed. Bodies of revolution: r
// along x.

/// A field's vector at a node.
Vector3 at(const NodeField& field, int node);
/// Place of a node in the undeformed body, and its place now.
Vector3 reference_place(const Body& body, int node);
Vector3 place_now(const Body& body, int node);

/// Sum of weight times field over a marker's nodes.
Vector3 carried(const NodeField& field, const Markers& markers, int marker);

Vector3 travel_of(const Body& body);

/// Moves a body at rest as a whole.
void move_body(Body& body, const Vector3& way);
/// Gives the body at rest a rigid motion: `velocity` of the point `centre` and a rotation about it.
void throw_body(Body& body, const Vector3& velocity, const Vector3& spin = Vector3::Zero(),
                const Vector3& centre = Vector3::Zero());

/// The same velocity to all nodes that are free to move.
void add_velocity(Body& body, const Vector3& velocity);
/// Takes `share` of every node's velocity relative to `bulk` out of the body; returns the gain of kinetic
/// energy.
double damp_velocity(Body& body, const Vector3& bulk, double share);

Vector3 momentum(const Body& body);
/// Velocity of the centre of mass of the whole body.
Vector3 mean_velocity(const Body& body);
Vector3 angular_momentum(const Body& body, const Vector3& centre);
/// The whole body's angular momentum from that of the part that is computed: mirrored parts cancel all but
/// the component along a mirror's normal.
Vector3 of_whole(const Body& body, Vector3 angular);

}  // namespace granulaw
