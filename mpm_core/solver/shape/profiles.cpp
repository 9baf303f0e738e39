#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw {

namespace {

using Points = std::vector<ProfilePoint>;
using std::numbers::pi;

/// Segments over `angle` of a circle so that the chord error, radius (1 - cos(half a segment)), stays below
/// 0.8e-6 of `scale`; never fewer than 8.
int segments_of_arc(double radius, double angle, double scale)
{
  const double least_cosine = 1 - 0.8e-6 * scale / radius;
  const double step = 2 * std::acos(std::max(least_cosine, 0.0));
  return std::max(8, static_cast<int>(std::ceil(angle / step)));
}

/// Appends the arc about `centre`, angles in radians from straight down, counter-clockwise; without its first
/// point where the curve already ends there. The widest point of the circle is always among them.
void add_arc(Points& profile, ProfilePoint centre, double radius, double from, double to, double scale)
{
  if (!(to - from > 1e-9)) return;  // a tablet with cap_radius = radius has no edge
  if (from < pi / 2 && to > pi / 2) {
    add_arc(profile, centre, radius, from, pi / 2, scale);
    from = pi / 2;
  }
  const int n = segments_of_arc(radius, to - from, scale);
  for (int k = profile.empty() ? 0 : 1; k <= n; ++k) {
    const double angle = from + (to - from) * k / n, half = std::sin(angle / 2);
    // 1 - cos as a square: z near the pole keeps its digits
    const double below = 2 * radius * half * half;
    profile.push_back({centre.r + radius * std::sin(angle), centre.z - radius + below});
  }
}

/// Share of the radius: no grid distinguishes a smaller rounding from a sharp edge.
constexpr double least_share = 1e-4;

void check_size(const char* key, double value, double radius, const std::string& where)
{
  if (!(value >= least_share * radius))
    fail(where, fmt::format("'{}' is too small to be resolved", key), fmt::format("{:g} m", value),
         fmt::format("{:g} m, {:g} of the radius, or more", least_share * radius, least_share));
}

/// The ends exactly on the axis, the first in the origin: rounding aside, that is where they are.
Points closed(Points profile)
{
  profile.front() = {0, 0};
  profile.back().r = 0;
  return profile;
}

}  // namespace

Points ellipsoid(double radius, double aspect)
{
  const double half_height = aspect * radius;
  // The affine image of a circle: its chord error grows with the larger semi-axis.
  const int n = 2 * segments_of_arc(std::max(radius, half_height), pi / 2, radius);  // even: has the equator
  Points profile;
  for (int k = 0; k <= n; ++k) {
    const double angle = pi * k / n, half = std::sin(angle / 2);
    profile.push_back({radius * std::sin(angle), 2 * half_height * half * half});
  }
  return closed(profile);
}

Points flattened_sphere(double radius, double flat_radius, double fillet, const std::string& where)
{
  if (!(flat_radius + fillet < radius))
    fail(where, "'flat_radius' and 'fillet' leave no sphere: their sum is",
         fmt::format("{:g} m", flat_radius + fillet), fmt::format("below the radius, {:g} m", radius));
  check_size("flat_radius", flat_radius, radius, where);
  check_size("fillet", fillet, radius, where);
  const double angle = std::asin(flat_radius / (radius - fillet));
  const double centre = fillet + (radius - fillet) * std::cos(angle);
  Points profile{{0, 0}};
  profile.push_back({flat_radius, 0});
  add_arc(profile, {flat_radius, fillet}, fillet, 0, angle, radius);
  add_arc(profile, {0, centre}, radius, angle, pi, radius);
  return closed(profile);
}

Points conical_tip(double radius, double half_angle, double tip_radius, const std::string& where)
{
  if (!(tip_radius < radius))
    fail(where, "'tip_radius' must be smaller than the body", fmt::format("{:g} m", tip_radius),
         fmt::format("below the radius, {:g} m", radius));
  check_size("tip_radius", tip_radius, radius, where);
  const double flank = half_angle * pi / 180;
  const double centre = tip_radius + (radius - tip_radius) / std::sin(flank);
  Points profile;
  add_arc(profile, {0, tip_radius}, tip_radius, 0, pi / 2 - flank, radius);
  const double start = pi / 2 - flank;
  profile.push_back({radius * std::sin(start), centre - radius * std::cos(start)});
  add_arc(profile, {0, centre}, radius, start, pi, radius);
  return closed(profile);
}

Points tablet(double radius, double height, double cap_radius, double edge_radius, const std::string& where)
{
  if (!(cap_radius >= radius && cap_radius <= 1000 * radius))
    fail(where, "'cap_radius' does not fit the band", fmt::format("{:g} m", cap_radius),
         fmt::format("the radius, {:g} m, to a thousand times it", radius));
  if (!(edge_radius < radius))
    fail(where, "'edge_radius' must be smaller than the body", fmt::format("{:g} m", edge_radius),
         fmt::format("below the radius, {:g} m", radius));
  check_size("edge_radius", edge_radius, radius, where);
  const double reach = cap_radius - edge_radius, out = radius - edge_radius;
  const double angle = std::asin(out / reach);
  const double band = cap_radius - reach * std::cos(angle);  // where the edge ends and the cylinder begins
  // (rounding: a height of exactly twice that is a tablet without a band)
  if (!(height >= 2 * band * (1 - 1e-12)))
    fail(where, "'height' is too small for the two caps and edges", fmt::format("{:g} m", height),
         fmt::format("{:g} m or more", 2 * band));
  Points profile;
  add_arc(profile, {0, cap_radius}, cap_radius, 0, angle, radius);
  add_arc(profile, {out, band}, edge_radius, angle, pi / 2, radius);
  profile.front() = {0, 0};
  const bool has_band = height > 2 * band * (1 + 1e-12);
  for (auto p = profile.size() - (has_band ? 0 : 1); p-- > 0;)
    profile.push_back({profile[p].r, height - profile[p].z});
  return profile;
}

Points outline(Points points, const std::string& where)
{
  if (points.size() < 3)
    fail(where, "the points enclose no body", fmt::format("{} points", points.size()), "3 or more");
  double widest = 0;
  for (const ProfilePoint& p : points) {
    if (!std::isfinite(p.r) || !std::isfinite(p.z))
      fail(where, "a point is not finite", fmt::format("[{:g}, {:g}] m", p.r, p.z));
    widest = std::max(widest, p.r);
  }
  if (widest == 0) fail(where, "the points enclose no body: none has an r over 0");
  const double tolerance = 1e-3 * widest;
  ProfilePoint& first = points.front();
  ProfilePoint& last = points.back();
  if (!(std::abs(first.r) <= tolerance && std::abs(first.z) <= tolerance))
    fail(where, "the first point must be the contact pole", fmt::format("[{:g}, {:g}] m", first.r, first.z),
         fmt::format("[0, 0] within {:g} m", tolerance));
  if (!(std::abs(last.r) <= tolerance))
    fail(where, "the last point must lie on the axis, at the far pole",
         fmt::format("[{:g}, {:g}] m", last.r, last.z), fmt::format("r = 0 within {:g} m", tolerance));
  return closed(std::move(points));
}

ShapeKind ellipsoid_profile_kind()
{
  return {"ellipsoid", {{"aspect", "", 0.05, 20}}, nullptr, [](const ShapeValues& v) {
            return ellipsoid(v.radius, v.number("aspect"));
          }};
}

ShapeKind flattened_sphere_kind()
{
  return {"flattened-sphere",
          {ShapeKey::positive("flat_radius", "m"), ShapeKey::positive("fillet", "m", false)},
          nullptr,
          [](const ShapeValues& v) {
            const double flat = v.number("flat_radius");
            const double default_fillet = std::max(0.1 * flat, least_share * v.radius);
            return flattened_sphere(v.radius, flat, v.has("fillet") ? v.number("fillet") : default_fillet,
                                    v.where(""));
          }};
}

ShapeKind conical_tip_kind()
{
  return {"conical-tip",
          {{"half_angle", "degrees", 5, 85}, ShapeKey::positive("tip_radius", "m")},
          nullptr,
          [](const ShapeValues& v) {
            return conical_tip(v.radius, v.number("half_angle"), v.number("tip_radius"), v.where(""));
          }};
}

ShapeKind tablet_kind()
{
  return {"tablet",
          {ShapeKey::positive("height", "m"), ShapeKey::positive("cap_radius", "m"),
           ShapeKey::positive("edge_radius", "m")},
          nullptr,
          [](const ShapeValues& v) {
            return tablet(v.radius, v.number("height"), v.number("cap_radius"), v.number("edge_radius"),
                          v.where(""));
          }};
}

}  // namespace granulaw
