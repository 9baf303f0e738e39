#include "deck/commands/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "deck/commands/reading.hpp"
#include "deck/mesh_file.hpp"

namespace granulaw::deck {

namespace {

/// One end of a region along an axis: a number, or INF or EDGE, which stand for the domain's.
double end(Words& w, double of_domain)
{
  return w.take("INF") || w.take("EDGE") ? of_domain : w.value();
}

/// Both ends along axis k.
void ends(Words& w, const Box& domain, std::size_t k, Box& box)
{
  box.low[k] = end(w, domain.empty() ? -Box::infinity : domain.low[k]);
  box.high[k] = end(w, domain.empty() ? Box::infinity : domain.high[k]);
}

std::size_t axis(Words& w)
{
  const std::string& name = w.word();
  if (name != "x" && name != "y" && name != "z") misread(fmt::format("'{}' is no axis", name));
  return static_cast<std::size_t>(name[0] - 'x');
}

/// A prism lies within the block of the same words.
Region block(const Reading& reading, Words& w)
{
  Region r;
  for (std::size_t k = 0; k < 3; ++k) ends(w, reading.scene.domain, k, r.box);
  r.volume = r.box.volume();
  return r;
}

/// The axis of a cylinder or cone, and where it lies across.
struct Section
{
  std::size_t axis;
  std::array<std::size_t, 2> across;
  std::array<double, 2> centre;
};

Section section(Words& w)
{
  const std::size_t along = axis(w);
  const std::array<std::size_t, 2> across{along == 0 ? 1u : 0u, along == 2 ? 1u : 2u};
  const double first = w.value(), second = w.value();
  return {along, across, {first, second}};
}

/// With the radii `low` and `high` at its ends.
Region truncated_cone(const Reading& reading, Words& w, const Section& s, double low, double high)
{
  Region r;
  for (std::size_t k = 0; k < 2; ++k) {
    r.box.low[s.across[k]] = s.centre[k] - std::max(low, high);
    r.box.high[s.across[k]] = s.centre[k] + std::max(low, high);
  }
  ends(w, reading.scene.domain, s.axis, r.box);
  r.volume = M_PI / 3 * (low * low + low * high + high * high) * r.box.size()[s.axis];
  return r;
}

/// axis c1 c2 radius low high
Region cylinder(const Reading& reading, Words& w)
{
  const Section s = section(w);
  const double radius = w.value();
  return truncated_cone(reading, w, s, radius, radius);
}

/// axis c1 c2 radius_low radius_high low high
Region cone(const Reading& reading, Words& w)
{
  const Section s = section(w);
  const double low = w.value(), high = w.value();
  return truncated_cone(reading, w, s, low, high);
}

Region wedge(const Reading&, Words&)
{
  misread("give its height by --drop-height");
}

Region sphere(const Reading&, Words& w)
{
  const Vec3 centre = w.vector();
  const double radius = w.value();
  Region r;
  r.box.include(centre - Vec3{radius, radius, radius});
  r.box.include(centre + Vec3{radius, radius, radius});
  r.volume = ball_volume(radius);
  return r;
}

/// N ID...
std::vector<Region> parts(const Reading& reading, Words& w)
{
  std::vector<Region> result;
  for (std::size_t n = w.count(); n > 0; --n) result.push_back(reading.regions.at(w.word()));
  return result;
}

/// Its volume is that of its parts, as if they did not overlap.
Region united(const Reading& reading, Words& w)
{
  Region all;
  for (const Region& part : parts(reading, w)) {
    all.box.include(part.box);
    all.volume += part.volume;
  }
  return all;
}

Region intersection(const Reading& reading, Words& w)
{
  const std::vector<Region> all = parts(reading, w);
  if (all.empty()) return {};
  Region common = all[0];
  for (const Region& part : all) {
    common.box = common.box.within(part.box);
    common.volume = std::min(common.volume, common.box.volume());
  }
  return common;
}

/// Its volume is that of the box around it.
Region tetrahedra(const Reading&, Words& w)
{
  const std::vector<Vec3> vertices = mesh_vertices(w.behind("file").path());
  double scale = 1;
  Vec3 move{0, 0, 0};
  if (auto value = w.after("scale")) scale = value->value();
  if (auto value = w.after("move")) move = value->vector();
  Region r;
  for (const Vec3& p : vertices) r.box.include(scale * p + move);
  r.volume = r.box.volume();
  return r;
}

struct Style
{
  std::string_view name;
  Region (*read)(const Reading& reading, Words& words);
};

/// The styles that are understood: a new one is a line here and a function above.
constexpr std::array styles{Style{"block", block},         Style{"cone", cone},
                            Style{"cylinder", cylinder},   Style{"intersect", intersection},
                            Style{"mesh/tet", tetrahedra}, Style{"prism", block},
                            Style{"sphere", sphere},       Style{"union", united},
                            Style{"wedge", wedge}};

Region read(const Reading& reading, const std::string& style, Words& w)
{
  std::vector<std::string> known;
  for (const Style& s : styles) {
    if (s.name == style) return s.read(reading, w);
    known.emplace_back(s.name);
  }
  misread(fmt::format("region style '{}' is not known to mpm plan", style), style, known);
}

bool is_outside(const Words& w)
{
  auto side = w.after("side");
  return side && side->take("out");
}

}  // namespace

void follow_region(Reading& reading, Words w)
{
  const std::string id = w.word(), style = w.word();
  Words rest = w;
  Region region = read(reading, style, rest);
  const Box& domain = reading.scene.domain;
  // what lies outside may lie anywhere in the domain
  if (is_outside(w) && !domain.empty()) region = {domain, domain.volume()};
  reading.regions.put(id, region);
}

}  // namespace granulaw::deck
