#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <vector>

namespace granulaw {

/// A point of a meridian curve, m: r from the axis, z above the contact pole.
struct ProfilePoint
{
  double r, z;
};

/// Meridian curve of a body of revolution: a polyline from the contact pole (0, 0) to the far pole
/// (0, height), SI, the body on its left. It never changes. Copies share the points and their search tree, so
/// a copy costs nothing and any number of threads may ask at once. Every list of points can be held;
/// validate(Particle) says whether it encloses a body, and only then do the answers below mean anything.
class Profile
{
 public:
  Profile() = default;  ///< no points: the particle is a sphere
  Profile(std::vector<ProfilePoint> points);
  Profile(std::initializer_list<ProfilePoint> points) : Profile(std::vector<ProfilePoint>(points)) {}

  bool empty() const { return !points_; }
  std::size_t size() const { return points_ ? points_->size() : 0; }
  const ProfilePoint& operator[](std::size_t k) const { return (*points_)[k]; }
  const ProfilePoint& front() const { return points_->front(); }
  const ProfilePoint& back() const { return points_->back(); }
  const ProfilePoint* begin() const { return points_ ? points_->data() : nullptr; }
  const ProfilePoint* end() const { return begin() + size(); }

  double height() const { return back().z; }  ///< m
  /// The point farthest from the axis; of several the first.
  const ProfilePoint& widest() const { return (*points_)[widest_]; }

  /// Distance to the curve, exactly, m, positive inside; r >= 0.
  double depth(double r, double z) const;
  /// Height at distance r >= 0 from the axis, m, of the part between the contact pole and the widest point:
  /// the lowest of several; beyond the widest point, its height.
  double surface_z(double r) const;
  /// Volume of the body of revolution, m^3.
  double volume() const;
  /// Radius of curvature R at the contact pole, m: z = r^2/(2 R) + c r^4 by least squares through the points
  /// with r up to `reach`, or fewer until the fit is good to 1e-4 of z (to 1e-3, 1e-2, 0.1 if it never is).
  /// Where three points are too few for that: the circle through the first, so that a sharp tip has nearly 0.
  /// Infinity for a flat tip.
  double pole_curvature_radius(double reach) const;

 private:
  std::shared_ptr<const std::vector<ProfilePoint>> points_;  ///< null: none
  class Segments;
  std::shared_ptr<const Segments> segments_;
  std::size_t widest_ = 0;
  bool rising_ = true;  ///< r never falls between the contact pole and the widest point
};

}  // namespace granulaw
