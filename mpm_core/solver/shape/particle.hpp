#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/impact_body.hpp"
#include "solver/material/material.hpp"
#include "solver/shape/revolved.hpp"
#include "solver/shape/shape.hpp"

namespace granulaw {

/// A body of revolution that hits along its axis; contact pole at (0, 0), body in z >= 0. SI.
/// Or a body of any shape, in the shape's frame. Then the statements below about (r, z) and the contact pole
/// have no meaning, and check_revolution() refuses it.
struct Particle
{
  /// All points nearer to the surface than `thickness` that belong to no layer further out.
  struct Layer
  {
    double thickness;  ///< m
    int material;      ///< index into materials
  };
  /// A ball on the axis (r = 0) or a ring (torus) of circular section; in a shape: a ball about (x, y, z), r
  /// = 0.
  struct Inclusion
  {
    double r, z, radius;  ///< m: centre of the section, radius of the section
    int material;         ///< index into materials; -1: a pore
    double x = 0, y = 0;  ///< m; in a shape only
  };

  /// m: sphere's radius; of a profile: its largest distance from the axis; with a shape: of the sphere of its
  /// volume
  double radius = 0;
  std::vector<Material> materials{};  ///< materials[0]: the body (core of a layered one)
  /// Curved shapes are sampled so finely that the chord error is below 1e-6 radius; empty: a sphere.
  Profile profile{};
  std::vector<Layer> layers{};          ///< from the surface inwards
  std::vector<Inclusion> inclusions{};  ///< later ones on top of earlier ones and of layers
  SharedShape shape{};                  ///< null: the body of revolution
  ImpactBody impact_body{};             ///< in impacts: see fixed_to()

  /// A homogeneous sphere.
  static Particle sphere(double radius, const Material& material);

  bool is_sphere() const { return profile.empty() && !shape; }
  bool is_homogeneous_sphere() const { return is_sphere() && layers.empty() && inclusions.empty(); }
  double height() const;                    ///< m
  double height_of_largest_radius() const;  ///< m, above the contact pole

  /// Radius of curvature at the contact pole, m. Sphere: radius. Profile: fitted within 0.1 radius of the
  /// pole (revolved.hpp); infinity for a flat tip.
  double pole_curvature_radius() const;

  /// Distance to the surface, m, positive inside. Of a profile: to the polyline, exactly.
  double depth(double r, double z) const;
  /// Largest depth inside, m, up to 1e-3 too small, with a shape 1e-2: layers must be thinner together. The
  /// search ends at the first depth over `enough`.
  double largest_depth(double enough = std::numeric_limits<double>::infinity()) const;
  /// Index into materials, -1: outside the body or in a pore. The surface itself is inside.
  int material_at(double r, double z) const { return material_of(depth(r, z), {r, 0, z}); }
  /// The same of a point of depth `depth` in the frame of shape_of().
  int material_at(const Vector3& x, double depth) const
  {
    return material_of(depth, shape ? x : x + Vector3(0, 0, 0.5 * height()));
  }
  double volume() const;  ///< m^3, enclosed by the outer surface
  /// Height of the lower surface above the pole at distance r, m: the part between the pole and the largest r
  /// (the lowest of several heights); beyond the largest r, its value there.
  double surface_z(double r) const;

 private:
  int material_of(double depth, const Vector3& x) const;  // x in the frame of the inclusions
};

/// The particle's surface in three dimensions. A body of revolution lies about the z axis with its middle in
/// the origin, so that its contact pole is (0, 0, -height/2).
SharedShape shape_of(const Particle& particle);

/// Throws Error "WHERE: ..." with one sentence if the geometry cannot be used. Materials themselves are
/// checked by validate(Material).
void validate(const Particle& particle, const std::string& where);

/// The particle with the mass of what it is fixed to, spread over its own volume: waves in it are slower, and forces
/// and work are those of the heavier body as long as the impact is slow beside them. Throws Error "WHERE: ..." where
/// it has several materials, or is heavier by itself.
Particle fixed_to(Particle particle, const ImpactBody& body, const std::string& where);

/// Throws Error "WHERE: ..." if the particle has a shape, where only bodies of revolution are taken.
void check_revolution(const Particle& particle, const std::string& where);

}  // namespace granulaw
