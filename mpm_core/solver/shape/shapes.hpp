#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "solver/shape/mesh.hpp"
#include "solver/shape/revolved.hpp"
#include "solver/shape/shape.hpp"

namespace granulaw {

// A factory for each kind of shape; SI. `where` leads the Error of what encloses no body.

/// About the origin.
SharedShape sphere_shape(double radius);

/// About the origin, its axes along x, y and z.
SharedShape ellipsoid_shape(const Vector3& half_axes);

/// LIGGGHTS's superquadric about the origin (superquadric.cpp, shape_function_local): half axes a, b, c and
/// `blockiness` n1, n2, both 2 or more, so that it is convex:
///
///     (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1
SharedShape superquadric_shape(const Vector3& half_axes, double n1, double n2);

/// About the origin, its sides along x, y and z, with rounded edges and corners: all points within
/// `edge_radius` of a box that is smaller by that on every side.
SharedShape box_shape(const Vector3& sides, double edge_radius);

/// All points within `edge_radius` of the convex hull of `corners`. For some hundred corners: the time goes
/// with their number to the fourth power.
SharedShape polyhedron_shape(const std::vector<Vector3>& corners, double edge_radius,
                             const std::string& where);

/// A ball of a clump, m.
struct ClumpBall
{
  Vector3 centre;
  double radius;
};

/// The union of overlapping balls: LIGGGHTS's multisphere. Balls inside others are left out.
SharedShape clump_shape(const std::vector<ClumpBall>& balls, const std::string& where);

/// Those of a clump that no other one hides; none of any other shape.
std::vector<ClumpBall> balls_of(const Shape& shape);

/// Balls of LIGGGHTS's multisphere file (fix particletemplate/multisphere, spheres file): lines of x y z r,
/// '#' begins a comment; all times `scale`.
std::vector<ClumpBall> read_clump(const std::string& path, double scale);

/// The body inside a closed triangle mesh (check_closed).
SharedShape mesh_shape(TriangleMesh mesh, const std::string& where);

/// The body of revolution of a meridian curve about the z axis, with the middle of its height in the origin:
/// its contact pole is (0, 0, -height/2). Polyline as it is: smooth curves are sampled finely (below).
SharedShape revolved_shape(Profile profile);

// Meridian curves by name, from the contact pole (0, 0) to the far pole; SI. `radius` is the largest distance
// from the axis. Curved parts are sampled with a chord error below 1e-6 radius, at points that lie on the
// curve; straight parts have their two ends. Each throws Error "WHERE: ..." where its values do not fit
// together. No length may be below 1e-4 radius.

/// (r/radius)^2 + (z/h - 1)^2 = 1 with the half height h = aspect * radius. Curvature radius at the pole:
/// radius / aspect.
std::vector<ProfilePoint> ellipsoid(double radius, double aspect);

/// A sphere whose contact pole is cut by a plane. The flat reaches exactly to `flat_radius`; from there an
/// arc of radius `fillet` leads, tangentially on both sides, to the sphere.
///
///          ___
///        /     \        height = radius + fillet + sqrt((radius - fillet)^2 - flat_radius^2)
///        \     /
///         (___)  <- fillet
std::vector<ProfilePoint> flattened_sphere(double radius, double flat_radius, double fillet,
                                           const std::string& where = "flattened-sphere");

/// A drop: a ball of `tip_radius` at the contact pole, a cone whose flank makes `half_angle` (degrees,
/// between axis and flank) and a sphere of `radius`, all tangential.
///
///          ___
///        /     \        distance of the two centres = (radius - tip_radius) / sin(half_angle)
///        \     /
///          \_/   <- tip_radius
std::vector<ProfilePoint> conical_tip(double radius, double half_angle, double tip_radius,
                                      const std::string& where = "conical-tip");

/// A biconvex tablet that hits on a cap: caps of sphere of `cap_radius`, a cylindrical band of `radius`, and
/// between them an arc of `edge_radius`, tangential to both; `height` from pole to pole.
std::vector<ProfilePoint> tablet(double radius, double height, double cap_radius, double edge_radius,
                                 const std::string& where = "tablet");

/// A measured outline, as given. An end within 1e-3 of the largest r from where it must lie (the contact pole
/// at (0, 0); the far pole on the axis) is moved there; farther off it is refused.
std::vector<ProfilePoint> outline(std::vector<ProfilePoint> points, const std::string& where = "points");

/// One key of a kind of shape in the materials file.
struct ShapeKey
{
  enum class Form {
    number,
    numbers,  ///< a list of `count` numbers
    points,   ///< a list of `least` to `most` points of `count` coordinates
    path      ///< of a file
  };
  const char* name;
  const char* unit;    ///< "m", "degrees", or "" for a ratio
  double least, most;  ///< allowed for each number, both included
  bool required = true;
  Form form = Form::number;
  std::size_t count = 1;
  const char* holds = "";  ///< of a list: its contents, in words

  static ShapeKey positive(const char* name, const char* unit, bool required = true);
  static ShapeKey lengths(const char* name);  ///< three, along x, y and z
  static ShapeKey file() { return {"file", "", 0, 0, true, Form::path}; }
  static ShapeKey scale() { return positive("scale", "", false); }
};

/// Values of a kind's keys, each within its bounds.
struct ShapeValues
{
  double radius = 0;                                     ///< m, the particle's own; 0: none
  std::map<std::string, std::vector<double>> numbers{};  ///< by key; points one after the other
  std::string path{};                                    ///< of the file
  /// Leads the messages about a key; "": about the shape.
  std::function<std::string(const char* key)> where = [](const char*) { return "shape"; };

  bool has(const char* key) const { return numbers.contains(key); }
  double number(const char* key) const { return numbers.at(key).front(); }
  double scale() const { return has("scale") ? number("scale") : 1; }
  std::vector<Vector3> points(const char* key) const;
  /// Values of ShapeKey::lengths. Throws Error where one is more than a hundred times another.
  Vector3 lengths(const char* key) const;
};

/// A shape as the materials file may name it. Its maker throws Error where the values do not fit together.
struct ShapeKind
{
  const char* name;
  std::vector<ShapeKey> keys;
  SharedShape (*shape)(const ShapeValues& values);                            ///< in three dimensions; or
  std::vector<ProfilePoint> (*profile)(const ShapeValues& values) = nullptr;  ///< a body of revolution

  /// The particle's own radius may be its size.
  bool takes_radius() const;
};

/// All kinds: materials file, help, checks and messages follow this list (shapes.cpp).
const std::vector<ShapeKind>& shape_kinds();

}  // namespace granulaw
