// Conditions on a particle's geometry: validate(Particle).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "solver/shape/particle.hpp"

namespace granulaw {

namespace {

std::string text(const ProfilePoint& p)
{
  return fmt::format("({:g}, {:g}) m", p.r, p.z);
}

/// Twice the area of the triangle abc: positive if c lies on the left of ab.
double turn(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c)
{
  return (b.r - a.r) * (c.z - a.z) - (b.z - a.z) * (c.r - a.r);
}

/// c, known to lie on the line ab, lies between a and b.
bool between(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c)
{
  return std::min(a.r, b.r) <= c.r && c.r <= std::max(a.r, b.r) && std::min(a.z, b.z) <= c.z &&
         c.z <= std::max(a.z, b.z);
}

bool cross(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c, const ProfilePoint& d)
{
  const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
  if (c_side == 0 && between(a, b, c)) return true;
  if (d_side == 0 && between(a, b, d)) return true;
  if (a_side == 0 && between(c, d, a)) return true;
  if (b_side == 0 && between(c, d, b)) return true;
  return (c_side > 0) != (d_side > 0) && (a_side > 0) != (b_side > 0) && c_side != 0 && d_side != 0 &&
         a_side != 0 && b_side != 0;
}

/// Sweeps upwards: a segment is compared with those that begin below its upper end.
void check_simple(const Profile& profile, const std::string& where)
{
  std::vector<std::size_t> order(profile.size() - 1);
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto low = [&](std::size_t k) { return std::min(profile[k].z, profile[k + 1].z); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double upper = std::max(profile[order[i]].z, profile[order[i] + 1].z);
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= upper; ++j) {
      const std::size_t a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
      const bool meet = b == a + 1  // neighbours share a point; only a fold lays one on the other
                            ? turn(profile[a], profile[b], profile[b + 1]) == 0 &&
                                  (between(profile[a], profile[b], profile[b + 1]) ||
                                   between(profile[b], profile[b + 1], profile[a]))
                            : cross(profile[a], profile[a + 1], profile[b], profile[b + 1]);
      if (meet)
        fail(where, "the profile crosses or touches itself",
             fmt::format("the segments after points {} {} and {} {}", a + 1, text(profile[a]), b + 1,
                         text(profile[b])));
    }
  }
}

void check_points(const Particle& p, const std::string& where)
{
  const Profile& profile = p.profile;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const ProfilePoint point = profile[k];
    const std::string name = fmt::format("point {} of the profile", k + 1);
    if (!std::isfinite(point.r) || !std::isfinite(point.z)) fail(where, name + " is not finite", text(point));
    if (point.r < 0) fail(where, name + " lies on the other side of the axis", text(point), "r of 0 or more");
    if (point.z < 0)
      fail(where, name + " lies below the contact pole, which must be the lowest", text(point),
           "z of 0 or more");
    if (k > 0 && std::hypot(point.r - profile[k - 1].r, point.z - profile[k - 1].z) <= 1e-10 * p.radius)
      fail(where, name + " repeats the one before", text(point));
    if (k > 0 && k + 1 < profile.size() && point.r == 0)
      fail(where, name + " lies on the axis, which only the two ends may", text(point), "r over 0");
  }
}

void check_ends(const Profile& profile, const std::string& where)
{
  if (profile.front().r != 0 || profile.front().z != 0)
    fail(where, "the profile must start at the contact pole", text(profile.front()), "(0, 0)");
  if (profile.back().r != 0)
    fail(where, "the profile must end on the axis, at the far pole", text(profile.back()), "r = 0");
}

void check_size(const Particle& p, const std::string& where)
{
  if (!(p.height() >= 0.01 * p.radius && p.height() <= 100 * p.radius))
    fail(where, "the body is too flat or too slender: its height", fmt::format("{:g} m", p.height()),
         fmt::format("{:g} to {:g} m, 0.01 to 100 times its radius", 0.01 * p.radius, 100 * p.radius));
  const double widest = p.profile.widest().r;
  if (!(std::abs(p.radius / widest - 1) <= 1e-6))
    fail(where, "'radius' is not the profile's largest distance from the axis",
         fmt::format("{:g} m", p.radius), fmt::format("{:g} m", widest));
}

void check_profile(const Particle& p, const std::string& where)
{
  if (p.profile.size() < 3)
    fail(where, "the profile encloses no body", fmt::format("{} points", p.profile.size()), "3 or more");
  check_points(p, where);
  check_ends(p.profile, where);
  check_simple(p.profile, where);
  check_size(p, where);
}

void check_material(const Particle& p, int material, bool pore_allowed, const std::string& name,
                    const std::string& where)
{
  if (material < (pore_allowed ? -1 : 0) || material >= static_cast<int>(p.materials.size()))
    fail(where, fmt::format("{} has a material that the particle does not", name),
         fmt::format("{}", material),
         fmt::format("{}0 to {}", pore_allowed ? "-1 (a pore), " : "", p.materials.size() - 1));
}

void check_layers(const Particle& p, const std::string& where)
{
  double thickness = 0;
  for (std::size_t k = 0; k < p.layers.size(); ++k) {
    const Particle::Layer& layer = p.layers[k];
    const std::string name = fmt::format("layer {}", k + 1);
    if (!(layer.thickness > 0 && std::isfinite(layer.thickness)))
      fail(where, fmt::format("'thickness' of {} is out of range", name),
           fmt::format("{:g} m", layer.thickness), "over 0");
    check_material(p, layer.material, false, name, where);
    thickness += layer.thickness;
  }
  if (p.layers.empty()) return;
  const double room = p.largest_depth(thickness);
  if (!(thickness < room))
    fail(where, "the layers leave no core: they are thicker than the body is deep",
         fmt::format("{:g} m", thickness), fmt::format("below {:g} m", room));
}

void check_inclusion(const Particle& p, const Particle::Inclusion& i, const std::string& name,
                     const std::string& where)
{
  const std::string centre =
      p.shape ? fmt::format("({:g}, {:g}, {:g}) m", i.x, i.y, i.z) : text(ProfilePoint{i.r, i.z});
  if (!(i.radius > 0 && std::isfinite(i.radius)))
    fail(where, fmt::format("'radius' of {} is out of range", name), fmt::format("{:g} m", i.radius),
         "over 0");
  if (!(i.r >= 0 && std::isfinite(i.r + i.x + i.y + i.z)))
    fail(where, fmt::format("the centre of {} is out of range", name), centre, "r of 0 or more");
  if (i.r > 0 && i.r < i.radius)
    fail(where, fmt::format("the ring that is {} overlaps itself on the axis", name),
         fmt::format("r = {:g} m", i.r), fmt::format("0 (a ball), or {:g} m and more", i.radius));
  check_material(p, i.material, true, name, where);
  const double room = p.shape ? p.shape->depth({i.x, i.y, i.z}) : p.depth(i.r, i.z);
  if (!(room > 0)) fail(where, fmt::format("{} has its centre outside the body", name), centre);
  if (!(i.radius < room))
    fail(where, fmt::format("{} reaches the surface: its radius", name), fmt::format("{:g} m", i.radius),
         fmt::format("below {:g} m at {}", room, centre));
}

}  // namespace

void check_revolution(const Particle& p, const std::string& where)
{
  if (p.shape)
    fail(where, "has a shape in three dimensions, which cannot be taken here yet",
         fmt::format("kind = \"{}\"", p.shape->kind()), "a sphere or a profile");
}

Particle fixed_to(Particle p, const ImpactBody& body, const std::string& where)
{
  if (body.mass == 0) return p;
  if (p.materials.size() > 1) fail(where, "an impact body goes with a particle of one material");
  const double own = p.materials.front().density * p.volume();
  if (!(body.mass >= own))
    fail(where, "'impact_body_mass' is below the particle's own", fmt::format("{:g} kg", body.mass), fmt::format("{:.4g} kg or more", own));
  p.materials.front().density *= body.mass / own;
  return p;
}

void validate(const Particle& p, const std::string& where)
{
  if (!(p.radius > 0 && std::isfinite(p.radius)))
    fail(where, "'radius' is out of range", fmt::format("{:g} m", p.radius), "over 0");
  if (p.materials.empty()) fail(where, "the particle has no material");
  if (!p.is_sphere() && !p.shape) check_profile(p, where);
  check_layers(p, where);
  for (std::size_t k = 0; k < p.inclusions.size(); ++k)
    check_inclusion(p, p.inclusions[k], fmt::format("inclusion {}", k + 1), where);
}

}  // namespace granulaw
