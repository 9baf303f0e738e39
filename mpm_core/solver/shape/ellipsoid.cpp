#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/shape/curvature.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

/// Largest root t of sum (a_i y_i/(t + a_i^2))^2 = 1 (Eberly, Distance from a Point to an Ellipse, an
/// Ellipsoid, or a Hyperellipsoid). The sum falls and is convex in t, so Newton's steps from its left never
/// pass the root. -a_min^2 if there is no root above that: then the point lies so deep that several surface
/// points are nearest.
double lagrange_multiplier(const Eigen::Array3d& a, const Eigen::Array3d& y)
{
  const double least = a.minCoeff();
  double along_least = 0;
  for (int k = 0; k < 3; ++k)
    if (a[k] == least) along_least = std::hypot(along_least, y[k]);
  double t = least * (along_least - least);
  for (int step = 0; step < 100; ++step) {
    double excess = -1, slope = 0;
    for (int k = 0; k < 3; ++k) {
      if (y[k] == 0 || (along_least == 0 && a[k] == least)) continue;
      const double share = a[k] * y[k] / (t + a[k] * a[k]);
      excess += share * share;
      slope -= 2 * share * share / (t + a[k] * a[k]);
    }
    if (!(excess > 0) || slope == 0) break;
    const double next = t - excess / slope;
    if (!(next - t > 1e-15 * (std::abs(t) + least * least))) break;
    t = next;
  }
  return t;
}

/// An ellipsoid about the origin, its axes along x, y and z.
class Ellipsoid : public Shape
{
 public:
  explicit Ellipsoid(const Vector3& half_axes) : axes_(half_axes) {}

  /// the distance itself, everywhere
  double depth(const Vector3& x) const override
  {
    const double distance = (x - nearest_surface_point(x)).norm();
    return (x.array() / axes_.array()).square().sum() <= 1 ? distance : -distance;
  }
  Vector3 outward_normal(const Vector3& x) const override
  {
    return (nearest_surface_point(x).array() / axes_.array().square()).matrix().normalized();
  }
  double support(const Vector3& direction, Vector3* where) const override
  {
    const Eigen::Array3d scaled = direction.array() * axes_.array();
    const double reach = scaled.matrix().norm();
    if (where) *where = (scaled * axes_.array() / reach).matrix();
    return reach;
  }
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    Vector3 where;
    support(direction, &where);
    const Vector3 weight = axes_.array().square().inverse();
    return radii_of_level_set(weight.cwiseProduct(where), weight.asDiagonal());
  }
  double finest_radius() const override
  {
    // The radii at an end of axis c are a^2/c and b^2/c.
    const double least = axes_.minCoeff();
    return least * least / axes_.maxCoeff();
  }
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override
  {
    const double volume = 4.0 / 3.0 * std::numbers::pi * axes_.prod();
    const Eigen::Array3d squares = axes_.array().square();
    const Vector3 moments = 0.2 * volume * (squares.sum() - squares);
    return {volume, Vector3::Zero(), moments.asDiagonal()};
  }
  const char* kind() const override { return "ellipsoid"; }
  std::string definition() const override
  {
    return fmt::format("ellipsoid {} {} {}", axes_.x(), axes_.y(), axes_.z());
  }

 private:
  Vector3 nearest_surface_point(const Vector3& x) const
  {
    const Eigen::Array3d a = axes_.array();
    Eigen::Array3d y = x.array().abs();
    y = (y > 1e-12 * a.minCoeff()).select(y, 0.0);  // below that, rounding hides the point's side
    const double t = lagrange_multiplier(a, y);
    Eigen::Array3d foot;
    double rest = 1;
    int free = -1;
    for (int k = 0; k < 3; ++k) {
      const bool is_free = t + a[k] * a[k] == 0;
      foot[k] = is_free ? 0 : a[k] * a[k] * y[k] / (t + a[k] * a[k]);
      rest -= foot[k] * foot[k] / (a[k] * a[k]);
      if (is_free) free = k;
    }
    if (free >= 0) foot[free] = a[free] * std::sqrt(std::max(rest, 0.0));
    for (int k = 0; k < 3; ++k) foot[k] = std::copysign(foot[k], x[k]);
    return foot.matrix();
  }

  Vector3 axes_;  // m, half axes
};

}  // namespace

SharedShape ellipsoid_shape(const Vector3& half_axes)
{
  return std::make_shared<Ellipsoid>(half_axes);
}

ShapeKind ellipsoid_kind()
{
  return {"ellipsoid", {ShapeKey::lengths("axes")}, [](const ShapeValues& v) {
            return ellipsoid_shape(v.lengths("axes"));
          }};
}

}  // namespace granulaw
