#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "solver/shape/profile.hpp"

namespace granulaw {

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

/// One key of a shape in the materials file.
struct ProfileKey
{
  const char* name;
  const char* unit;    ///< "m", "degrees", or "" for a ratio
  double least, most;  ///< allowed, both included
  bool required = true;
};

/// A shape as the materials file may name it. The file's `radius` and values within their bounds go to
/// `make`, which throws Error "WHERE: ..." if they do not fit together; keys that are not required may be
/// missing.
struct ProfileShape
{
  using Values = std::map<std::string, double>;
  std::string name;
  std::vector<ProfileKey> keys;
  std::vector<ProfilePoint> (*make)(double radius, const Values& values, const std::string& where);
};

/// A new shape: one function above, and its entry in this list. Materials file and checks follow it.
const std::vector<ProfileShape>& profile_shapes();

}  // namespace granulaw
