#include "solver/shape/revolved_solid.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/gauss.hpp"

namespace granulaw {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_mirrored(const Profile& profile)
{
  const double rounding = 1e-9 * profile.height();
  return std::all_of(profile.begin(), profile.end(), [&](const ProfilePoint& p) {
    return std::abs(profile.depth(p.r, profile.height() - p.z)) <= rounding;
  });
}

double radius_of(double curvature)
{
  return curvature == 0 ? infinity : 1 / curvature;
}

}  // namespace

RevolvedSolid::RevolvedSolid(Profile profile) : profile_(std::move(profile)), mirrored_(is_mirrored(profile_))
{
}

double RevolvedSolid::depth(const Vector3& x) const
{
  return profile_.depth(std::hypot(x.x(), x.y()), x.z() + 0.5 * profile_.height());
}

Vector3 RevolvedSolid::outward_normal(const Vector3& x) const
{
  const double r = std::hypot(x.x(), x.y()), z = x.z() + 0.5 * profile_.height();
  const double step = 1e-6 * profile_.height();
  // The depth is even in r.
  const double along_r = profile_.depth(std::abs(r - step), z) - profile_.depth(r + step, z);
  const double along_z = profile_.depth(r, z - step) - profile_.depth(r, z + step);
  const Vector3 outward = r > 0 ? Vector3(x.x() / r, x.y() / r, 0) : Vector3(1, 0, 0);
  const Vector3 normal = along_r * outward + along_z * Vector3::UnitZ();
  return normal.norm() > 0 ? Vector3(normal.normalized()) : Vector3::UnitZ();
}

std::size_t RevolvedSolid::farthest(double n_r, double n_z) const
{
  const auto reach = [&](const ProfilePoint& p) { return n_r * p.r + n_z * p.z; };
  const auto best =
      std::max_element(profile_.begin(), profile_.end(),
                       [&](const ProfilePoint& a, const ProfilePoint& b) { return reach(a) < reach(b); });
  return static_cast<std::size_t>(best - profile_.begin());
}

double RevolvedSolid::support(const Vector3& direction, Vector3* where) const
{
  const double n_r = std::hypot(direction.x(), direction.y());
  const ProfilePoint p = profile_[farthest(n_r, direction.z())];
  const double z = p.z - 0.5 * profile_.height();
  if (where) {
    const Vector3 outward = n_r > 0 ? Vector3(direction.x() / n_r, direction.y() / n_r, 0) : Vector3(1, 0, 0);
    *where = p.r * outward + z * Vector3::UnitZ();
  }
  return n_r * p.r + direction.z() * z;
}

double RevolvedSolid::meridian_curvature(std::size_t k) const
{
  const std::size_t last = profile_.size() - 1;
  const ProfilePoint b = profile_[k];
  const ProfilePoint a = k > 0 ? profile_[k - 1] : ProfilePoint{-profile_[1].r, profile_[1].z};
  const ProfilePoint c =
      k < last ? profile_[k + 1] : ProfilePoint{-profile_[last - 1].r, profile_[last - 1].z};
  const double turn = (b.r - a.r) * (c.z - b.z) - (b.z - a.z) * (c.r - b.r);
  return 2 * turn /
         (std::hypot(b.r - a.r, b.z - a.z) * std::hypot(c.r - b.r, c.z - b.z) *
          std::hypot(c.r - a.r, c.z - a.z));
}

PrincipalRadii RevolvedSolid::principal_radii(const Vector3& direction) const
{
  const double n_r = std::hypot(direction.x(), direction.y());
  const std::size_t k = farthest(n_r, direction.z());
  const double meridian = radius_of(meridian_curvature(k)), r = profile_[k].r;
  if (r == 0) return {meridian, meridian, direction.unitOrthogonal()};
  const Vector3 around = n_r > 0 ? Vector3(-direction.y() / n_r, direction.x() / n_r, 0) : Vector3(0, 1, 0);
  const double hoop = n_r > 0 ? r / n_r : infinity;
  if (hoop < meridian) return {hoop, meridian, around};
  return {meridian, hoop, around.cross(direction)};
}

double RevolvedSolid::finest_radius() const
{
  double least = infinity;
  for (std::size_t k = 0; k < profile_.size(); ++k) {
    const double curvature = meridian_curvature(k);
    if (curvature > 0) least = std::min(least, 1 / curvature);
  }
  return least;
}

MassProperties RevolvedSolid::mass_properties() const
{
  // Discs of radius r(z), linear over a segment: the integrands are polynomials of degree 4 at most.
  double volume = 0, first = 0, axial = 0, across = 0;
  for (std::size_t k = 0; k + 1 < profile_.size(); ++k) {
    const ProfilePoint a = profile_[k], b = profile_[k + 1];
    const auto integrate = [&](const auto& f) {
      return std::numbers::pi * (b.z - a.z) * gauss<4>(0, 1, [&](double t) {
               return f(a.r + t * (b.r - a.r), a.z + t * (b.z - a.z) - 0.5 * profile_.height());
             });
    };
    volume += integrate([](double r, double) { return r * r; });
    first += integrate([](double r, double z) { return r * r * z; });
    axial += integrate([](double r, double) { return r * r * r * r / 2; });
    across += integrate([](double r, double z) { return r * r * (r * r / 4 + z * z); });
  }
  const double middle = first / volume;
  across -= volume * middle * middle;
  return {volume, {0, 0, middle}, Vector3(across, across, axial).asDiagonal()};
}

std::string RevolvedSolid::definition() const
{
  std::string text = kind();
  for (const ProfilePoint& p : profile_) text += fmt::format(" {},{}", p.r, p.z);
  return text;
}

}  // namespace granulaw
