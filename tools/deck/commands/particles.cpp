#include "deck/commands/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

/// One on every site of the lattice.
void fill(const Reading& reading, const Region& place, Source& s)
{
  s.centres = place.box;
  if (reading.lattice_volume > 0) s.count = std::ceil(place.volume / reading.lattice_volume);
}

/// `random N SEED REGION`, NULL for the whole box.
void scatter(const Reading& reading, Words& w, Source& s)
{
  s.count = w.value();
  w.value();
  s.centres = w.take("NULL") ? reading.scene.domain : reading.regions.at(w.word()).box;
}

/// TYPE single|region|box|random ...
Source created(const Reading& reading, Words w)
{
  Source s;
  s.where = w.where();
  s.type = w.atom_type();
  const std::string style = w.word();
  if (style == "single") {
    s.centres.include(w.vector());
    s.count = 1;
  } else if (style == "box") {
    fill(reading, {reading.scene.domain, reading.scene.domain.volume()}, s);
  } else if (style == "region") {
    fill(reading, reading.regions.at(w.word()), s);
  } else if (style == "random") {
    scatter(reading, w, s);
  } else {
    misread(fmt::format("'{}' is not understood", style));
  }
  return s;
}

/// The keywords of `set`.
struct Change
{
  double radius = 0, density = 0;  // 0: as it is
  std::optional<Vec3> velocity;
};

Change change(Reading& reading, Words& w)
{
  Change result;
  while (w.more()) {
    const std::string& word = w.word();
    if (word == "diameter") {
      result.radius = 0.5 * w.value();
    } else if (word == "density") {
      result.density = w.value();
    } else if (word == "vx" || word == "vy" || word == "vz") {
      if (!result.velocity) result.velocity = Vec3{0, 0, 0};
      (*result.velocity)[static_cast<std::size_t>(word[1] - 'x')] = w.value();
    } else if (word == "shape") {
      reading.scene.unknown_particles.push_back(
          fmt::format("{}: set shape: only spheres are understood", w.where()));
    } else if (word == "x" || word == "y" || word == "z") {
      reading.scene.unknown_heights.push_back(fmt::format("{}: set {}: heights change", w.where(), word));
    }
  }
  return result;
}

/// `whole`: it holds for all particles of the source, else for some of them.
void apply(const Change& change, bool whole, Source& s)
{
  s.together.clear();
  if (change.radius > 0) {
    s.radius_min = whole || s.radius_min == 0 ? change.radius : std::min(s.radius_min, change.radius);
    s.radius_max = whole ? change.radius : std::max(s.radius_max, change.radius);
  }
  if (change.density > 0) s.density = change.density;
  if (change.velocity) s.speed = std::max(s.speed, norm(*change.velocity));
}

}  // namespace

void bring_particles(Reading& reading, const Words& w, const std::function<void()>& bring)
{
  try {
    bring();
  } catch (const Unknown& error) {
    reading.scene.unknown_particles.push_back(
        fmt::format("{}: particles are not known: {}", w.where(), error.what()));
    throw;
  }
}

void follow_create_atoms(Reading& reading, Words w)
{
  bring_particles(reading, w, [&] { reading.scene.sources.push_back(created(reading, w)); });
}

void follow_set(Reading& reading, Words w)
{
  const std::string kind = w.word(), which = w.word();
  const int only_type =
      kind == "type" ? static_cast<int>(std::clamp(number(which).value_or(0), 0.0, 1e6)) : 0;
  const Change wanted = change(reading, w);
  for (Source& s : reading.scene.sources)
    if (only_type == 0 || s.type == only_type) apply(wanted, kind == "group" || kind == "type", s);
}

void follow_velocity(Reading& reading, Words w)
{
  w.word();  // group
  if (w.word() != "set") misread("only 'velocity ... set' is followed");
  Vec3 velocity{0, 0, 0};
  for (double& component : velocity)
    if (!w.take("NULL")) component = w.value();
  for (Source& s : reading.scene.sources) {
    s.speed = std::max(s.speed, norm(velocity));
    s.together.clear();
  }
}

void follow_displacement(Reading& reading, Words w)
{
  reading.scene.unknown_heights.push_back(fmt::format("{}: {} is not followed", w.where(), w.name()));
}

void follow_adapt(Reading& reading, const Fix&, Words w)
{
  reading.scene.unknown_particles.push_back(
      fmt::format("{}: fix adapt changes the particles while it runs", w.where()));
}

void follow_clumps(Reading& reading, const Fix& fix, Words w)
{
  reading.scene.unknown_particles.push_back(
      fmt::format("{}: fix {}: bodies of several spheres", w.where(), fix.style));
}

void follow_force(Reading& reading, const Fix& fix, Words w)
{
  reading.scene.unknown_speeds.push_back(fmt::format("{}: fix {} changes velocities", w.where(), fix.style));
}

}  // namespace granulaw::deck
