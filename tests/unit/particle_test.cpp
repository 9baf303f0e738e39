// Geometry of particles against closed forms, and every sentence of validate.
#include "solver/shape/particle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <thread>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "refusal.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::particle_test {

using std::numbers::pi;

Particle body(double radius, std::vector<ProfilePoint> profile = {})
{
  Particle p;
  p.radius = radius;
  p.materials.resize(3);
  p.profile = std::move(profile);
  return p;
}

TEST(Particle, SphereInClosedForm)
{
  const Particle p = body(2e-3);
  EXPECT_TRUE(p.is_sphere() && p.is_homogeneous_sphere());
  EXPECT_DOUBLE_EQ(p.height(), 4e-3);
  EXPECT_DOUBLE_EQ(p.pole_curvature_radius(), 2e-3);
  EXPECT_DOUBLE_EQ(p.volume(), 4.0 / 3.0 * pi * 8e-9);
  EXPECT_DOUBLE_EQ(p.depth(0, 2e-3), 2e-3);
  EXPECT_NEAR(p.depth(3e-3, 6e-3), -3e-3, 1e-17);  // 3-4-5 triangle; rounding
  EXPECT_NEAR(p.surface_z(1.2e-3), 0.4e-3, 1e-17);
  // z = r^2/2R (1 + (r/R)^2/4 ...): the direct difference of near numbers would keep 5 digits here
  EXPECT_NEAR(p.surface_z(2e-9) / 1e-15, 1, 1e-12);
  EXPECT_EQ(p.material_at(0, 1e-3), 0);
  EXPECT_EQ(p.material_at(0, -1e-9), -1);
  EXPECT_EQ(Particle::sphere(3e-3, Material{}).radius, 3e-3);
  validate(p, "here");
}

// Relative, by which a polyline inscribed with a chord error of 1e-6 radius falls short of its volume: 2/3 of
// that error times surface over volume, which is 3 to 6 over the radius in these tests.
constexpr double volume_error = 4e-6;

TEST(Particle, Ellipsoids)
{
  for (const double aspect : {0.3, 0.5, 1.0, 1.7, 4.0, 20.0}) {
    const double radius = 1e-3;
    const Particle p = body(radius, ellipsoid(radius, aspect));
    validate(p, "ellipsoid");
    EXPECT_FALSE(p.is_sphere());
    EXPECT_DOUBLE_EQ(p.height(), 2 * aspect * radius);
    EXPECT_NEAR(p.volume() / (4.0 / 3.0 * pi * std::pow(radius, 3) * aspect), 1, volume_error) << aspect;
    // curvature at the end of semi-axis c of r^2/a^2 + z^2/c^2 = 1: a^2/c; the fit is cut off after r^4: the
    // next term is 1/16 0.1^4 of the first one, about 1e-5
    EXPECT_NEAR(p.pole_curvature_radius() / (radius / aspect), 1, 3e-5) << aspect;
    for (const ProfilePoint& point : p.profile) ASSERT_NEAR(std::hypot(point.r / radius, point.z / (aspect * radius) - 1), 1, 1e-14);  // rounding
    // the true curve is nowhere farther than the chord error from the polyline
    for (int k = 0; k <= 10000; ++k) {
      const double t = pi * k / 10000;
      ASSERT_NEAR(p.depth(radius * std::sin(t), aspect * radius * (1 - std::cos(t))), 0, 1e-6 * radius) << t;
    }
    for (const double x : {0.0, 0.001, 0.1, 0.5, 0.9})
      EXPECT_NEAR(p.surface_z(x * radius), aspect * radius * (1 - std::sqrt(1 - x * x)), 1e-6 * radius * std::max(1.0, aspect * x / std::sqrt(1 - x * x)))
          << x;  // chord error along z: over the cosine of the slope
    EXPECT_DOUBLE_EQ(p.surface_z(2 * radius), p.surface_z(radius));
    EXPECT_NEAR(p.surface_z(radius), aspect * radius, 1e-12 * radius);
    // largest ball inside: touches the equator if prolate, the poles if oblate; found to 1e-3
    EXPECT_NEAR(p.largest_depth() / (radius * std::min(1.0, aspect)), 1, 1e-3) << aspect;
  }
}

/// Signed distance near the surface of a shape of arcs and lines, in closed form.
using Distance = std::function<double(double r, double z)>;

void expect_surface(const Particle& p, const Distance& distance, const char* name)
{
  validate(p, name);
  for (std::size_t k = 0; k + 1 < p.profile.size(); ++k)
    for (const double t : {0.0, 0.5})  // points lie on the curve, chords within the error bound
      ASSERT_NEAR(distance(p.profile[k].r + t * (p.profile[k + 1].r - p.profile[k].r), p.profile[k].z + t * (p.profile[k + 1].z - p.profile[k].z)), 0,
                  t == 0 ? 1e-14 * p.height() : 1e-6 * p.radius)
          << name << " " << k;
  double widest = 0;
  for (const ProfilePoint& point : p.profile) widest = larger(widest, point.r);
  EXPECT_DOUBLE_EQ(widest, p.radius) << name;
  // and depth agrees with it in a layer about the surface
  for (int k = 0; k <= 2000; ++k) {
    const std::size_t i = k * (p.profile.size() - 2) / 2000;
    const ProfilePoint a = p.profile[i], b = p.profile[i + 1];
    const double length = std::hypot(b.r - a.r, b.z - a.z);
    for (const double inward : {-0.01, -1e-4, 1e-4, 0.01}) {
      const double r = 0.5 * (a.r + b.r) - inward * p.radius * (b.z - a.z) / length;
      const double z = 0.5 * (a.z + b.z) + inward * p.radius * (b.r - a.r) / length;
      if (r < 0) continue;
      ASSERT_NEAR(p.depth(r, z), distance(r, z), 1e-6 * p.radius) << name << " " << r << " " << z;
    }
  }
}

TEST(Particle, FlattenedSphere)
{
  const double radius = 1e-3, flat = 0.3e-3, fillet = 0.05e-3;
  const Particle p = body(radius, flattened_sphere(radius, flat, fillet));
  const double centre = fillet + std::sqrt(std::pow(radius - fillet, 2) - flat * flat);
  expect_surface(
      p,
      [&](double r, double z) {
        if (r <= flat && z < centre / 2) return z;
        if ((r - flat) * (centre - fillet) > flat * (centre - z) - flat * (centre - fillet))
          return radius - std::hypot(r, z - centre);  // beyond the ray from the centre through the fillet's
        return fillet - std::hypot(r - flat, z - fillet);
      },
      "flattened-sphere");
  EXPECT_EQ(p.pole_curvature_radius(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(p.surface_z(flat), 0);
  // a fillet of next to nothing: a sphere less a cap
  const Particle cut = body(radius, flattened_sphere(radius, flat, 1e-4 * radius));
  const double h = radius - std::sqrt(radius * radius - flat * flat);
  EXPECT_NEAR(cut.volume() / (4.0 / 3.0 * pi * std::pow(radius, 3) - pi * h * h * (3 * radius - h) / 3), 1, volume_error);
}

TEST(Particle, ConicalTip)
{
  const double radius = 1e-3, tip = 0.1e-3;
  for (const double degrees : {15.0, 30.0, 60.0, 85.0}) {
    const double flank = degrees * pi / 180, centre = tip + (radius - tip) / std::sin(flank);
    const Particle p = body(radius, conical_tip(radius, degrees, tip));
    expect_surface(
        p,
        [&](double r, double z) {
          // position along the flank's direction (sin, cos) says which of the three pieces is nearest
          const double along = r * std::sin(flank) + (z - tip) * std::cos(flank);
          const double end = (radius - tip) / std::tan(flank);
          if (along < 0) return tip - std::hypot(r, z - tip);
          if (along > end) return radius - std::hypot(r, z - centre);
          return tip + (z - tip) * std::sin(flank) - r * std::cos(flank);
        },
        "conical-tip");
    EXPECT_DOUBLE_EQ(p.height(), centre + radius);
    // the fit may be off by 1e-4 of z; where the cap is small (85 degrees: it ends at 0.0087 radius) it must
    // keep within it
    EXPECT_NEAR(p.pole_curvature_radius() / tip, 1, 2e-3) << degrees;
  }
}

TEST(Particle, Tablet)
{
  const double radius = 1e-3, height = 0.9e-3, cap = 1.5e-3, edge = 0.1e-3;
  const Particle p = body(radius, tablet(radius, height, cap, edge));
  const double out = radius - edge, reach = cap - edge, band = cap - std::sqrt(reach * reach - out * out);
  expect_surface(
      p,
      [&](double r, double z) {
        z = std::min(z, height - z);
        if (z > band) return radius - r;
        if (r * (cap - band) < out * (cap - z)) return cap - std::hypot(r, cap - z);
        return edge - std::hypot(r - out, z - band);
      },
      "tablet");
  EXPECT_NEAR(p.pole_curvature_radius() / cap, 1, 3e-5);  // as for the ellipsoid
  // an edge of next to nothing: a cylinder between two caps
  const Particle sharp = body(radius, tablet(radius, height, cap, 1e-4 * radius));
  const double h = cap - std::sqrt(cap * cap - radius * radius);
  EXPECT_NEAR(sharp.volume() / (pi * radius * radius * (height - 2 * h) + 2 * pi * h * h * (3 * cap - h) / 3), 1, volume_error);
  // at its limits it is a sphere, with no edge and no band
  const Particle round = body(radius, tablet(radius, 2 * radius, radius, edge));
  expect_surface(
      round, [&](double r, double z) { return radius - std::hypot(r, z - radius); }, "round tablet");
}

TEST(Particle, Outlines)
{
  // measured: moved onto the axis within 1e-3 of the largest r, refused beyond
  const std::vector<ProfilePoint> points{{1e-7, -1e-7}, {1e-3, 0.2e-3}, {1e-3, 1.5e-3}, {0.9e-6, 2e-3}};
  const Particle p = body(1e-3, outline(points));
  validate(p, "outline");
  EXPECT_EQ(p.profile.front().r, 0);
  EXPECT_EQ(p.profile.front().z, 0);
  EXPECT_EQ(p.profile.back().r, 0);
  EXPECT_THROW(outline({{0, 0}, {1e-3, 0.2e-3}, {1e-3, 1.5e-3}, {1.1e-6, 2e-3}}), Error);
  EXPECT_THROW(outline({{0, 1.1e-6}, {1e-3, 0.2e-3}, {0, 2e-3}}), Error);
  // cone, cylinder, cone: closed form, and its sharp tip
  const Particle spindle = body(2e-3, {{0, 0}, {2e-3, 2e-3}, {2e-3, 3e-3}, {0, 5e-3}});
  EXPECT_NEAR(spindle.volume() / (pi * 4e-6 * (1e-3 + 2 * 2e-3 / 3)), 1, 1e-14);  // rounding
  EXPECT_NEAR(spindle.depth(0, 1e-3), 1e-3 / std::numbers::sqrt2, 1e-17);
  EXPECT_NEAR(spindle.depth(0, -1e-3), -1e-3, 1e-17);
  EXPECT_NEAR(spindle.surface_z(0.5e-3), 0.5e-3, 1e-17);
  EXPECT_DOUBLE_EQ(spindle.surface_z(2e-3), 2e-3);
  std::vector<ProfilePoint> dense{{0, 0}};
  for (int k = 1; k <= 1000; ++k) dense.push_back({1e-6 * k, 1e-6 * k});
  dense.push_back({0, 2e-3});
  EXPECT_LT(body(1e-3, dense).pole_curvature_radius(), 1e-5);
  // an outline with errors of 1e-5 of its size: the fit reaches farther instead of following them
  std::vector<ProfilePoint> rough = ellipsoid(1e-3, 1);
  for (std::size_t k = 1; k + 1 < rough.size(); ++k) rough[k].z += 1e-8 * (1 + std::sin(37.0 * static_cast<double>(k)));
  EXPECT_NEAR(body(1e-3, rough).pole_curvature_radius() / 1e-3, 1,
              0.02);  // 2e-8 of z = 5e-6 there: 0.4 %, and slack
  // a dimple: the lowest of several heights
  const Particle dimple = body(1e-3, {{0, 0}, {0.8e-3, 1e-3}, {0.6e-3, 0.2e-3}, {1e-3, 0.5e-3}, {1e-3, 2e-3}, {0, 3e-3}});
  validate(dimple, "dimple");
  EXPECT_NEAR(dimple.surface_z(0.7e-3), 0.2e-3 + 0.3e-3 / 4, 1e-17);
}

TEST(Particle, LayersAndInclusions)
{
  for (Particle p : {body(1e-3), body(1e-3, ellipsoid(1e-3, 1))}) {
    p.layers = {{0.1e-3, 1}, {0.2e-3, 2}};
    EXPECT_FALSE(p.is_homogeneous_sphere());
    validate(p, "layers");
    const auto at = [&](double depth, double angle) {
      const double rho = 1e-3 - depth;
      return p.material_at(rho * std::sin(angle), 1e-3 - rho * std::cos(angle));
    };
    for (const double angle : {0.0, 0.3, 1.5, 3.0}) {
      EXPECT_EQ(at(-1e-6, angle), -1);
      EXPECT_EQ(at(2e-6, angle), 1);
      EXPECT_EQ(at(0.098e-3, angle), 1);
      EXPECT_EQ(at(0.102e-3, angle), 2);
      EXPECT_EQ(at(0.298e-3, angle), 2);
      EXPECT_EQ(at(0.302e-3, angle), 0);
    }
    // a ring through both layers, a pore in it, a ball on the axis
    const double r = 0.6e-3, z = 1e-3, a = 0.35e-3;
    p.inclusions = {{r, z, a, 1}, {r, z, 0.1e-3, -1}, {0, 0.5e-3, 0.2e-3, 2}};
    validate(p, "inclusions");
    EXPECT_EQ(p.material_at(r + 0.99 * a, z), 1);
    EXPECT_EQ(p.material_at(r, z - 0.99 * a), 1);
    EXPECT_EQ(p.material_at(r, z + 0.09e-3), -1);
    EXPECT_EQ(p.material_at(r, z + 0.11e-3), 1);
    EXPECT_EQ(p.material_at(0.19e-3, 0.5e-3), 2);
    EXPECT_EQ(p.material_at(0, 1e-3), 0);
  }
}

TEST(Particle, ChangedProfilesAreNoticed)
{
  Particle p = body(1e-3, ellipsoid(1e-3, 1));
  EXPECT_NEAR(p.depth(0, 0.3e-3), 0.3e-3, 1e-9);
  const Particle copy = p;
  p.profile = ellipsoid(2e-3, 1);
  EXPECT_NEAR(p.depth(0, 3e-3), 1e-3, 1e-8);
  EXPECT_NEAR(copy.depth(0, 0.3e-3), 0.3e-3, 1e-9);
  p.profile = copy.profile;
  EXPECT_NEAR(p.depth(0, 0.3e-3), 0.3e-3, 1e-9);
  p = body(1e-3, ellipsoid(1e-3, 0.5));
  EXPECT_NEAR(p.depth(0, 0.9e-3), 0.1e-3, 1e-9);
}

TEST(Particle, ManyThreadsMayAsk)
{
  const Particle p = body(1e-3, ellipsoid(1e-3, 1));
  std::vector<std::thread> threads;
  std::vector<int> inside(4);
  for (int& count : inside)
    threads.emplace_back([&] {
      for (int k = 0; k < 1000; ++k) count += p.depth(0, 2.2e-6 * k) > 0;
    });
  for (std::thread& thread : threads) thread.join();
  for (const int count : inside) EXPECT_EQ(count, 909);  // 0 itself is on the surface
}

/// A body that is star-shaped about (0, centre): inside and outside known from the angle alone.
struct Star
{
  double centre;
  std::vector<ProfilePoint> points;

  bool inside(double r, double z) const
  {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const ProfilePoint a{points[k].r, points[k].z - centre}, b{points[k + 1].r, points[k + 1].z - centre};
      const double y = z - centre, from = a.r * y - a.z * r, to = r * b.z - y * b.r;
      if (from < 0 || to < 0) continue;  // not between the rays to a and b
      return (b.r - a.r) * (y - a.z) - (b.z - a.z) * (r - a.r) > 0;
    }
    return false;
  }
  double distance(double r, double z) const
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const ProfilePoint a = points[k], b = points[k + 1];
      const double l2 = std::pow(b.r - a.r, 2) + std::pow(b.z - a.z, 2);
      const double t = std::clamp(((r - a.r) * (b.r - a.r) + (z - a.z) * (b.z - a.z)) / l2, 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(r - a.r - t * (b.r - a.r), z - a.z - t * (b.z - a.z)));
    }
    return nearest;
  }
};

RC_GTEST_PROP(Particle, RandomBodies, ())
{
  const auto number = [](double least, double most) { return least + (most - least) * *rc::gen::inRange(0, 1000001) * 1e-6; };
  const int n = *rc::gen::inRange(3, 80);
  Star star{number(0.4, 1), {}};
  for (int k = 0; k <= n; ++k) {
    const double angle = pi * k / n;
    double reach = k == 0 ? star.centre : number(0.3, 1);
    if (k > 0 && std::cos(angle) > 0) reach = std::min(reach, star.centre / std::cos(angle));
    star.points.push_back({reach * std::sin(angle), star.centre - reach * std::cos(angle)});
  }
  star.points.front() = {0, 0};
  star.points.back().r = 0;
  for (ProfilePoint& p : star.points) p.z = larger(p.z, 0.0);
  double radius = 0;
  for (const ProfilePoint& p : star.points) radius = larger(radius, p.r);
  Particle p = body(radius, star.points);
  validate(p, "star");
  const double room = p.largest_depth(), first = number(0.05, 0.4) * room, second = number(0.05, 0.4) * room;
  p.layers = {{first, 1}, {second, 2}};
  p.inclusions = {{0, star.centre, number(0.01, 0.2), -1}};
  validate(p, "layered star");
  const Particle::Inclusion pore = p.inclusions[0];
  for (int k = 0; k < 200; ++k) {
    const double r = number(0, 1.2), z = number(-0.2, 2.2);
    const double depth = p.depth(r, z), distance = star.distance(r, z);
    RC_ASSERT(std::abs(std::abs(depth) - distance) < 1e-14);  // rounding of numbers about 1
    RC_ASSERT(depth <= room * (1 + 1e-3));
    if (distance < 1e-12) continue;  // on the surface rounding decides
    const bool inside = star.inside(r, z);
    RC_ASSERT((depth > 0) == inside);
    const double from_pore = std::hypot(r - pore.r, z - pore.z);
    if (std::abs(from_pore - pore.radius) < 1e-12) continue;
    const int expected = !inside ? -1 : from_pore < pore.radius ? -1 : depth < first ? 1 : depth < first + second ? 2 : 0;
    RC_ASSERT(p.material_at(r, z) == expected);
  }
}

RC_GTEST_PROP(Particle, EveryShapeThatIsMadeIsValid, ())
{
  const double radius = 2e-3;
  std::vector<ShapeKind> profiles = shape_kinds();
  std::erase_if(profiles, [](const ShapeKind& kind) { return !kind.profile; });
  const ShapeKind kind = profiles[*rc::gen::inRange(std::size_t{0}, profiles.size())];
  ShapeValues values;
  values.radius = radius;
  for (const ShapeKey& key : kind.keys) {
    if (!key.required && *rc::gen::arbitrary<bool>()) continue;
    // lengths from 1e-4 to 1 radii, those of the body itself from 1 to 100; each decade as likely
    const std::string name = key.name;
    const bool length = key.unit == std::string("m"), large = name == "height" || name == "cap_radius";
    const double least = length ? (large ? 1 : 1e-4) * radius : key.least;
    const double most = length ? (large ? 100 : 1) * radius : key.most;
    values.numbers[key.name] = {least * std::pow(most / least, *rc::gen::inRange(0, 1001) * 1e-3)};
  }
  Particle p = body(radius);
  try {
    p.profile = kind.profile(values);
  } catch (const Error&) {
    RC_TAG(std::string(kind.name) + " refused");
    return;
  }
  RC_TAG(std::string(kind.name));
  // (a tablet of 100 radii and a rounding more)
  if (p.height() < 100 * radius) validate(p, "shape");
  RC_ASSERT(p.volume() > 0);
  RC_ASSERT(p.pole_curvature_radius() > 0);
}

TEST(Particle, RefusesWithASentence)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<ProfilePoint> good{{0, 0}, {1, 0.5}, {1, 1.5}, {0, 2}};
  const auto with = [&](std::size_t k, ProfilePoint point) {
    std::vector<ProfilePoint> points = good;
    points[k] = point;
    return body(1, points);
  };
  Particle sphere = body(1), layered = body(1), profile = body(1, good);
  const auto layers = [&](std::vector<Particle::Layer> list) {
    Particle p = layered;
    p.layers = std::move(list);
    return p;
  };
  const auto inclusion = [&](Particle::Inclusion i, const Particle& of) {
    Particle p = of;
    p.inclusions = {{0, 1, 0.1, 0}, i};
    return p;
  };
  Particle bare = body(1);
  bare.materials.clear();
  validate(profile, "here");
  const struct
  {
    Particle particle;
    const char* sentence;
  } cases[] = {
      {body(0), "here: 'radius' is out of range: found 0 m, allowed is over 0"},
      {body(nan), "here: 'radius' is out of range"},
      {body(inf), "here: 'radius' is out of range"},
      {bare, "here: the particle has no material"},
      {body(1, {{0, 0}, {0, 2}}), "here: the profile encloses no body: found 2 points"},
      {with(1, {nan, 0.5}), "here: point 2 of the profile is not finite"},
      {with(1, {-1, 0.5}), "here: point 2 of the profile lies on the other side of the axis: found (-1, 0.5) m"},
      {with(1, {1, -0.5}), "here: point 2 of the profile lies below the contact pole, which must be the lowest"},
      {with(1, {1, 1.5}), "here: point 3 of the profile repeats the one before"},
      {with(1, {0, 0.5}), "here: point 2 of the profile lies on the axis, which only the two ends may"},
      {with(0, {0, 0.1}), "here: the profile must start at the contact pole: found (0, 0.1) m"},
      {with(3, {0.1, 2}), "here: the profile must end on the axis, at the far pole: found (0.1, 2) m"},
      {body(1, {{0, 0}, {1, 1}, {1, 0.5}, {0.3, 1.5}, {0, 2}}), "here: the profile crosses or touches itself"},
      {body(1, {{0, 0}, {0.5, 0.5}, {1, 0.2}, {1, 1}, {0.5, 0.5}, {0, 2}}), "here: the profile crosses or touches"},
      {body(1, {{0, 0}, {1, 1}, {0.5, 0.5}, {0, 2}}), "here: the profile crosses or touches itself"},
      {body(1, {{0, 0}, {1, 50}, {0, 101}}), "here: the body is too flat or too slender: its height: found 101 m"},
      {body(1, {{0, 0}, {1, 4e-3}, {0, 9e-3}}), "here: the body is too flat or too slender"},
      {body(1.01, good), "here: 'radius' is not the profile's largest distance from the axis: found 1.01 m"},
      {layers({{0, 1}}), "here: 'thickness' of layer 1 is out of range: found 0 m, allowed is over 0"},
      {layers({{0.1, 1}, {nan, 1}}), "here: 'thickness' of layer 2 is out of range"},
      {layers({{0.1, 3}}), "here: layer 1 has a material that the particle does not: found 3, allowed is 0 to 2"},
      {layers({{0.1, -1}}), "here: layer 1 has a material that the particle does not: found -1"},
      {layers({{0.5, 1}, {0.5, 2}}), "here: the layers leave no core"},
      {inclusion({0, 1, 0, 0}, sphere), "here: 'radius' of inclusion 2 is out of range"},
      {inclusion({-0.1, 1, 0.1, 0}, sphere), "here: the centre of inclusion 2 is out of range"},
      {inclusion({0.1, nan, 0.1, 0}, sphere), "here: the centre of inclusion 2 is out of range"},
      {inclusion({0.1, 1, 0.11, 0}, sphere), "here: the ring that is inclusion 2 overlaps itself on the axis"},
      {inclusion({0, 1, 0.1, 3}, sphere), "here: inclusion 2 has a material that the particle does not: found 3"},
      {inclusion({0, 1, 0.1, -2}, sphere), "here: inclusion 2 has a material that the particle does not: found -2"},
      {inclusion({0, 2.5, 0.1, -1}, sphere), "here: inclusion 2 has its centre outside the body"},
      {inclusion({0, 0.25, 0.25, -1}, sphere), "here: inclusion 2 reaches the surface: its radius: found 0.25 m"},
      {inclusion({0.8, 1, 0.2, -1}, profile), "here: inclusion 2 reaches the surface: its radius: found 0.2 m"},
  };
  for (const auto& [particle, sentence] : cases) {
    const std::string found = sentence_of([&] { validate(particle, "here"); });
    EXPECT_EQ(found.rfind(sentence, 0), 0u) << "wanted: " << sentence << "\nfound:  " << found;
  }
  // just below the pole is fine; a ring that touches the axis too
  validate(inclusion({0, 0.2, 0.199, -1}, sphere), "here");
  validate(inclusion({0.1, 1, 0.1, 0}, sphere), "here");
}

TEST(Particle, ShapesRefuseWhatDoesNotFit)
{
  const auto begins = [](const std::function<void()>& act, const std::string& sentence) {
    const std::string found = sentence_of(act);
    EXPECT_EQ(found.rfind(sentence, 0), 0u) << "wanted: " << sentence << "\nfound:  " << found;
  };
  begins([] { flattened_sphere(1, 0.9, 0.1, "p"); }, "p: 'flat_radius' and 'fillet' leave no sphere");
  begins([] { conical_tip(1, 30, 1, "p"); }, "p: 'tip_radius' must be smaller than the body: found 1 m");
  begins([] { tablet(1, 1, 0.9, 0.1, "p"); }, "p: 'cap_radius' does not fit the band: found 0.9 m");
  begins([] { tablet(1, 1, 2, 1, "p"); }, "p: 'edge_radius' must be smaller than the body: found 1 m");
  begins([] { tablet(1, 0.1, 2, 0.1, "p"); }, "p: 'height' is too small for the two caps and edges: found 0.1 m");
  begins([] { tablet(1, 1, 2, 1e-5, "p"); }, "p: 'edge_radius' is too small to be resolved: found 1e-05 m");
  begins([] { conical_tip(1, 30, 1e-5, "p"); }, "p: 'tip_radius' is too small to be resolved");
  begins([] { flattened_sphere(1, 1e-5, 0.1, "p"); }, "p: 'flat_radius' is too small to be resolved");
  begins([] { flattened_sphere(1, 0.1, 1e-5, "p"); }, "p: 'fillet' is too small to be resolved");
  begins([] { outline({{0, 0}, {NAN, 1}, {0, 2}}, "p"); }, "p: a point is not finite: found [nan, 1] m");
  begins([] { outline({{0, 0}, {0, 1}, {0, 2}}, "p"); }, "p: the points enclose no body: none has an r over 0");
  begins([] { outline({{0, 0}, {1, 1}}, "p"); }, "p: the points enclose no body: found 2 points");
  begins([] { outline({{0.1, 0}, {1, 1}, {0, 2}}, "p"); }, "p: the first point must be the contact pole");
  begins([] { outline({{0, 0}, {1, 1}, {0.1, 2}}, "p"); }, "p: the last point must lie on the axis");
}

}  // namespace granulaw::particle_test
