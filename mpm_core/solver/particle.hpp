#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "solver/material.hpp"

namespace granulaw {

/// A point of a meridian curve, m: r from the axis, z above the contact pole.
struct ProfilePoint
{
  double r, z;
};

class ProfileTree;

/// Keeps the search tree of a profile from the first query on; several threads may ask at once. A copy
/// starts empty.
class ProfileCache
{
 public:
  ProfileCache() = default;
  ProfileCache(const ProfileCache&) {}
  ProfileCache& operator=(const ProfileCache&);
  ~ProfileCache();
  const ProfileTree& tree(const std::vector<ProfilePoint>& profile) const;

 private:
  mutable std::atomic<const ProfileTree*> newest_{nullptr};
};

/// A body of revolution that hits along its axis; contact pole at (0, 0), body in z >= 0. SI.
struct Particle
{
  /// All points nearer to the surface than `thickness` that belong to no layer further out.
  struct Layer
  {
    double thickness;  ///< m
    int material;      ///< index into materials
  };
  /// A ball on the axis (r = 0) or a ring (torus) of circular section.
  struct Inclusion
  {
    double r, z, radius;  ///< m: centre of the section, radius of the section
    int material;         ///< index into materials; -1: a pore
  };

  double radius = 0;  ///< m: sphere's radius; of a profile: its largest distance from the axis
  std::vector<Material> materials{};  ///< materials[0]: the body (core of a layered one)
  /// From the contact pole (0, 0) to the far pole (0, height), dense polyline (curved shapes sampled so
  /// finely that the chord error is < 1e-6 radius); empty: a sphere. Between queries change it as a whole
  /// only: the search tree notices a new or a scaled profile, not a single point that moved.
  std::vector<ProfilePoint> profile{};
  std::vector<Layer> layers{};          ///< from the surface inwards
  std::vector<Inclusion> inclusions{};  ///< later ones on top of earlier ones and of layers
  ProfileCache cache{};                 ///< not for users

  bool is_sphere() const { return profile.empty(); }
  bool is_homogeneous_sphere() const { return is_sphere() && layers.empty() && inclusions.empty(); }
  double height() const;  ///< m

  /// Radius of curvature at the contact pole, m. Sphere: radius. Profile: z = r^2/(2 R) + c r^4 by least
  /// squares through its points near the pole: those with r up to 0.1 radius, or fewer until the fit is good
  /// to 1e-4 of z (to 1e-3, 1e-2, 0.1 if it never is). Where three points are too few for that: the circle
  /// through the first, so that a sharp tip has nearly 0. Infinity for a flat tip.
  double pole_curvature_radius() const;

  /// Distance to the surface, m, positive inside. Of a profile: to the polyline, exactly.
  double depth(double r, double z) const;
  /// Largest depth inside, m, up to 1e-3 too small: layers must be thinner together.
  double largest_depth() const;
  /// Index into materials, -1: outside the body or in a pore. The surface itself is inside.
  int material_at(double r, double z) const;
  double volume() const;  ///< m^3, enclosed by the outer surface
  /// Height of the lower surface above the pole at distance r, m: the part between the pole and the largest r
  /// (the lowest of several heights); beyond the largest r, its value there.
  double surface_z(double r) const;

  Particle scaled(double factor) const;  ///< all lengths times `factor`; materials unchanged
  static Particle from(const Sphere& sphere);
};

/// Throws Error "WHERE: ..." with one sentence if the geometry cannot be used. Materials themselves are
/// checked by validate(Material).
void validate(const Particle& particle, const std::string& where);

}  // namespace granulaw
