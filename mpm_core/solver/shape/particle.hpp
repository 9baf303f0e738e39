#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/material/material.hpp"
#include "solver/shape/profile.hpp"

namespace granulaw {

class Solid;

/// A body of revolution that hits along its axis; contact pole at (0, 0), body in z >= 0. SI.
/// Or a body of any shape: a Solid, in the solid's frame (solver/shape/body_frame.hpp). Then what is said
/// below of (r, z) and of the contact pole has no meaning, and check_revolution() refuses it.
struct Particle
{
  /// All points nearer to the surface than `thickness` that belong to no layer further out.
  struct Layer
  {
    double thickness;  ///< m
    int material;      ///< index into materials
  };
  /// A ball on the axis (r = 0) or a ring (torus) of circular section; of a solid: a ball about (x, y, z), r
  /// = 0.
  struct Inclusion
  {
    double r, z, radius;  ///< m: centre of the section, radius of the section
    int material;         ///< index into materials; -1: a pore
    double x = 0, y = 0;  ///< m; of a solid only
  };

  /// m: sphere's radius; of a profile: its largest distance from the axis; of a solid: of the sphere of its
  /// volume
  double radius = 0;
  std::vector<Material> materials{};  ///< materials[0]: the body (core of a layered one)
  /// Curved shapes are sampled so finely that the chord error is below 1e-6 radius; empty: a sphere.
  Profile profile{};
  std::vector<Layer> layers{};           ///< from the surface inwards
  std::vector<Inclusion> inclusions{};   ///< later ones on top of earlier ones and of layers
  std::shared_ptr<const Solid> solid{};  ///< null: the body of revolution

  bool is_sphere() const { return profile.empty() && !solid; }
  bool is_homogeneous_sphere() const { return is_sphere() && layers.empty() && inclusions.empty(); }
  double height() const;                    ///< m
  double height_of_largest_radius() const;  ///< m, above the contact pole

  /// Radius of curvature at the contact pole, m. Sphere: radius. Profile: fitted within 0.1 radius of the
  /// pole (profile.hpp); infinity for a flat tip.
  double pole_curvature_radius() const;

  /// Distance to the surface, m, positive inside. Of a profile: to the polyline, exactly.
  double depth(double r, double z) const;
  /// Largest depth inside, m, up to 1e-3 too small: layers must be thinner together.
  double largest_depth() const;
  /// Index into materials, -1: outside the body or in a pore. The surface itself is inside.
  int material_at(double r, double z) const;
  /// Index into materials of a point of this depth that lies in no inclusion; -1: outside.
  int material_at_depth(double depth) const;
  double volume() const;  ///< m^3, enclosed by the outer surface
  /// Height of the lower surface above the pole at distance r, m: the part between the pole and the largest r
  /// (the lowest of several heights); beyond the largest r, its value there.
  double surface_z(double r) const;

  /// All lengths times `factor`; materials unchanged. Not of a solid.
  Particle scaled(double factor) const;
  static Particle from(const Sphere& sphere);
};

/// Throws Error "WHERE: ..." with one sentence if the geometry cannot be used. Materials themselves are
/// checked by validate(Material).
void validate(const Particle& particle, const std::string& where);

/// Throws Error "WHERE: ..." if the particle is a solid, for what takes bodies of revolution only.
void check_revolution(const Particle& particle, const std::string& where);

}  // namespace granulaw
