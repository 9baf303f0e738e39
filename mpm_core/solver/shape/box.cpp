#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

/// Integrals over the body of 1, x^2, y^2, z^2.
struct Moments
{
  double volume = 0;
  Vector3 square = Vector3::Zero();
};

/// The eighth of the body in the positive octant, made of 8 parts: along each axis a part either spans the
/// inner box, from 0 to p, or is part of a ball of radius r about the end of it. `ball` has a bit for each
/// such axis.
Moments part_of_octant(const Vector3& p, double r, int ball)
{
  // A quarter of a ball's volume element in m dimensions, 2^-m of the ball: volume, and first and second
  // moments of one coordinate from the ball's centre.
  constexpr double pi = std::numbers::pi;
  const int dimensions = (ball & 1) + (ball >> 1 & 1) + (ball >> 2 & 1);
  const double volume[] = {1, r, pi * r * r / 4, pi * r * r * r / 6};
  const double first[] = {0, r * r / 2, r * r * r / 3, pi * std::pow(r, 4) / 16};
  const double second[] = {0, r * r * r / 3, pi * std::pow(r, 4) / 16, pi * std::pow(r, 5) / 30};
  double inner = 1;
  for (int k = 0; k < 3; ++k)
    if (!(ball >> k & 1)) inner *= p[k];
  Moments m;
  m.volume = inner * volume[dimensions];
  for (int k = 0; k < 3; ++k)
    m.square[k] =
        ball >> k & 1
            ? inner * (p[k] * p[k] * volume[dimensions] + 2 * p[k] * first[dimensions] + second[dimensions])
            : m.volume * p[k] * p[k] / 3;
  return m;
}

/// A box about the origin, its sides along x, y and z, with rounded edges and corners: all points within
/// `edge_radius` of a box that is smaller by that on every side.
class Box : public Shape
{
 public:
  Box(const Vector3& sides, double edge_radius)
      : inner_(0.5 * sides - Vector3::Constant(edge_radius)), edge_radius_(edge_radius)
  {
  }

  /// the distance itself, everywhere
  double depth(const Vector3& x) const override
  {
    const Vector3 beyond = x.cwiseAbs() - inner_;
    return edge_radius_ - beyond.cwiseMax(0.0).norm() - std::min(beyond.maxCoeff(), 0.0);
  }
  Vector3 outward_normal(const Vector3& x) const override
  {
    const Vector3 beyond = x.cwiseAbs() - inner_;
    Vector3 normal = beyond.cwiseMax(0.0);
    if (normal.isZero(0)) {
      int nearest;
      beyond.maxCoeff(&nearest);
      normal[nearest] = 1;
    }
    for (int k = 0; k < 3; ++k) normal[k] = std::copysign(normal[k], x[k]);
    return normal.normalized();
  }
  double support(const Vector3& direction, Vector3* where) const override
  {
    if (where)
      for (int k = 0; k < 3; ++k)
        (*where)[k] =
            (direction[k] == 0 ? 0 : std::copysign(inner_[k], direction[k])) + edge_radius_ * direction[k];
    return direction.cwiseAbs().dot(inner_) + edge_radius_;
  }
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    // The normal has one component that is not zero on a face, two on an edge, three at a corner.
    constexpr double flat = std::numeric_limits<double>::infinity();
    int along = 0;
    direction.cwiseAbs().minCoeff(&along);
    switch ((direction.array() != 0).count()) {
      case 1:
        return {flat, flat, direction.unitOrthogonal()};
      case 2:
        return {edge_radius_, flat, Vector3::Unit(along).cross(direction)};
      default:
        return {edge_radius_, edge_radius_, direction.unitOrthogonal()};
    }
  }
  double finest_radius() const override { return edge_radius_; }
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override
  {
    Moments whole;
    for (int ball = 0; ball < 8; ++ball) {
      const Moments part = part_of_octant(inner_, edge_radius_, ball);
      whole.volume += 8 * part.volume;
      whole.square += 8 * part.square;
    }
    const Vector3 inertia = Vector3::Constant(whole.square.sum()) - whole.square;
    return {whole.volume, Vector3::Zero(), inertia.asDiagonal()};
  }
  const char* kind() const override { return "box"; }
  std::string definition() const override
  {
    return fmt::format("box {} {} {}, {}", inner_.x(), inner_.y(), inner_.z(), edge_radius_);
  }

 private:
  Vector3 inner_;  // m, half sides without the rounding
  double edge_radius_;
};

}  // namespace

SharedShape box_shape(const Vector3& sides, double edge_radius)
{
  return std::make_shared<Box>(sides, edge_radius);
}

ShapeKind box_kind()
{
  return {
      "box", {ShapeKey::lengths("sides"), ShapeKey::positive("edge_radius", "m")}, [](const ShapeValues& v) {
        const Vector3 sides = v.lengths("sides");
        const double radius = v.number("edge_radius"), least = 1e-3 * sides.minCoeff(),
                     most = 0.5 * sides.minCoeff();
        if (!(radius >= least && radius <= most))
          fail(v.where("edge_radius"), "'edge_radius' does not fit the sides", fmt::format("{:g} m", radius),
               fmt::format("{:g} to {:g} m, a thousandth to half of the shortest side", least, most));
        return box_shape(sides, radius);
      }};
}

}  // namespace granulaw
