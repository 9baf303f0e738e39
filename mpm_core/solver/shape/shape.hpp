#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>

namespace granulaw {

using Vector3 = Eigen::Vector3d;

/// Mass properties of a body of density 1 kg/m^3; multiplied by the density for the real ones.
struct MassProperties
{
  double volume;            ///< m^3
  Vector3 centre;           ///< m, centre of mass
  Eigen::Matrix3d inertia;  ///< m^5, inertia tensor about the centre of mass
};

/// From the volume and the integrals of x and of x x^t over the body.
MassProperties mass_of_moments(double volume, const Vector3& first, const Eigen::Matrix3d& second);

/// Principal radii of curvature of a surface at one point, m: 0 at an edge, 0 and 0 at a corner, infinity
/// where it is flat. Positive where the surface is convex, negative where it is hollow.
struct PrincipalRadii
{
  double sharper, flatter;    ///< of larger and of smaller curvature
  Vector3 sharper_direction;  ///< unit tangent in which the surface has the radius `sharper`
};

/// The outer surface of a three-dimensional body, in its own frame; SI. It never changes, so any number of
/// threads may ask at once. Made by the factories of shapes.hpp.
class Shape
{
 public:
  virtual ~Shape() = default;

  /// Signed distance to the surface, m, positive inside. Exact at the surface to first order and changing by
  /// no more than the distance between two points; a class says where it is not the distance itself.
  virtual double depth(const Vector3& x) const = 0;
  /// Unit vector out of the body: minus the gradient of the depth. One of the possible ones where several
  /// are.
  virtual Vector3 outward_normal(const Vector3& x) const = 0;

  /// Largest n.x over the body, m, n the unit vector `direction`. `where`, if not null, becomes a point that
  /// reaches it: the contact point with a plane of outward normal -n.
  virtual double support(const Vector3& direction, Vector3* where) const = 0;
  /// Radii of the surface at the support point of the unit vector `direction`.
  virtual PrincipalRadii principal_radii(const Vector3& direction) const = 0;
  /// Smallest radius of curvature of a convex part of the surface that a grid must resolve, m; infinity:
  /// none.
  virtual double finest_radius() const = 0;

  /// Smallest box along the axes that holds the body.
  void bounds(Vector3& low, Vector3& high) const;
  /// Mirror symmetry about the planes x = 0, y = 0, z = 0.
  virtual std::array<bool, 3> symmetric() const { return {false, false, false}; }
  virtual MassProperties mass_properties() const = 0;

  virtual const char* kind() const = 0;  ///< as the materials file names it
  /// The kind and all numbers that define the body: bodies are equal if their texts are.
  virtual std::string definition() const = 0;
};

using SharedShape = std::shared_ptr<const Shape>;

}  // namespace granulaw
