#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "base/error.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

/// A sphere about the origin.
class Sphere : public Shape
{
 public:
  explicit Sphere(double radius) : radius_(radius) {}

  double depth(const Vector3& x) const override { return radius_ - x.norm(); }
  Vector3 outward_normal(const Vector3& x) const override
  {
    const double distance = x.norm();
    return distance > 0 ? Vector3(x / distance) : Vector3::UnitZ();
  }
  double support(const Vector3& direction, Vector3* where) const override
  {
    if (where) *where = radius_ * direction;
    return radius_;
  }
  PrincipalRadii principal_radii(const Vector3& direction) const override
  {
    return {radius_, radius_, direction.unitOrthogonal()};
  }
  double finest_radius() const override { return radius_; }
  std::array<bool, 3> symmetric() const override { return {true, true, true}; }
  MassProperties mass_properties() const override
  {
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
    return {volume, Vector3::Zero(), 0.4 * volume * radius_ * radius_ * Eigen::Matrix3d::Identity()};
  }
  const char* kind() const override { return "sphere"; }
  std::string definition() const override { return fmt::format("sphere {}", radius_); }

 private:
  double radius_;  // m
};

}  // namespace

SharedShape sphere_shape(double radius)
{
  return std::make_shared<Sphere>(radius);
}

ShapeKind sphere_kind()
{
  return {"sphere", {ShapeKey::positive("radius", "m", false)}, [](const ShapeValues& v) {
            if (v.has("radius")) return sphere_shape(v.number("radius"));
            if (!(v.radius > 0)) fail(v.where(""), "the key 'radius' is missing");
            return sphere_shape(v.radius);
          }};
}

}  // namespace granulaw
