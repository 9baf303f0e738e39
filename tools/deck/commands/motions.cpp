#include "deck/commands/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

/// A motion that has no known speed: the plan asks for it.
[[noreturn]] void refuse(Reading& reading, const Words& w, const std::string& style, const std::string& why)
{
  reading.scene.unknown_speeds.push_back(fmt::format("{}: fix move/mesh {}: {}", w.where(), style, why));
  misread(why + ": give the speed by --speed");
}

/// 2 pi over the period, or omega.
double angular_frequency(Reading& reading, const Words& w, const std::string& style)
{
  if (auto period = w.after("period")) {
    const double t = period->value();
    if (t == 0) misread("its period is 0");
    return 2 * M_PI / std::abs(t);
  }
  if (auto omega = w.after("omega")) return std::abs(omega->value());
  refuse(reading, w, style, "neither a period nor omega");
}

/// Where the point `p` circles: centre, unit axis, radius.
struct Circle
{
  Vec3 centre, axis;
  double radius;
};

Circle circle_of(const Vec3& p, const Motion& m)
{
  const Vec3 axis = 1 / norm(m.axis) * m.axis;
  const Vec3 arm = p - m.origin, along = dot(arm, axis) * axis;
  return {m.origin + along, axis, norm(arm - along)};
}

/// A motion, and the largest speed that it gives to the mesh.
struct Moving
{
  Motion motion;
  double speed = 0;
};

/// `linear VX VY VZ`
Moving linear(Reading&, const std::string&, Words w, const Box&)
{
  Moving m;
  m.motion.velocity = w.vector();
  m.speed = norm(m.motion.velocity);
  return m;
}

/// `wiggle amplitude X Y Z period T`
Moving wiggle(Reading& reading, const std::string& style, Words w, const Box&)
{
  Moving m;
  m.motion.amplitude = w.behind("amplitude").vector();
  m.speed = norm(m.motion.amplitude) * angular_frequency(reading, w, style);
  return m;
}

/// `rotate origin X Y Z axis X Y Z period T`
Moving rotate(Reading& reading, const std::string& style, Words w, const Box& box)
{
  Moving m;
  m.motion.turns = true;
  m.motion.origin = w.behind("origin").vector();
  if (auto axis = w.after("axis")) m.motion.axis = axis->vector();
  if (norm(m.motion.axis) == 0) misread("its axis is 0");
  double farthest = 0;
  for (const Vec3& p : box.corners()) farthest = std::max(farthest, circle_of(p, m.motion).radius);
  m.speed = angular_frequency(reading, w, style) * farthest;
  return m;
}

/// `riggle origin X Y Z axis X Y Z period T amplitude DEGREES`: its largest angular speed is the amplitude
/// times 2 pi/T.
Moving riggle(Reading& reading, const std::string& style, Words w, const Box& box)
{
  Moving m = rotate(reading, style, w, box);
  m.speed *= std::abs(w.behind("amplitude").value()) * M_PI / 180;
  return m;
}

struct Style
{
  std::string_view name;
  Moving (*read)(Reading& reading, const std::string& style, Words words, const Box& box);
};

/// The motions that are understood: a new one is a line here and a function above.
constexpr std::array styles{Style{"linear", linear}, Style{"riggle", riggle}, Style{"rotate", rotate},
                            Style{"wiggle", wiggle}};

Moving read(Reading& reading, const std::string& style, const Words& w, const Box& box)
{
  for (const Style& s : styles)
    if (s.name == style) return s.read(reading, style, w, box);
  refuse(reading, w, style, "this motion is not followed");
}

/// The box around everything that `box` can reach by the motion within `duration`.
Box sweep(const Box& box, const Motion& m, double duration)
{
  Box swept = box;
  for (const Vec3& p : box.corners()) {
    swept.include(p + duration * m.velocity);
    swept.include(p + m.amplitude);
    swept.include(p - m.amplitude);
    if (!m.turns) continue;
    const Circle circle = circle_of(p, m);
    for (std::size_t k = 0; k < 3; ++k) {
      const double extent = circle.radius * std::sqrt(std::max(0.0, 1 - circle.axis[k] * circle.axis[k]));
      swept.low[k] = std::min(swept.low[k], circle.centre[k] - extent);
      swept.high[k] = std::max(swept.high[k], circle.centre[k] + extent);
    }
  }
  return swept;
}

}  // namespace

void follow_motion(Reading& reading, const Fix& fix, Words w)
{
  if (!w.take("mesh")) misread("'mesh' is missing");
  const std::string id = w.word();
  Mesh& mesh = reading.meshes.at(id);
  const std::string style = w.word();
  Moving moving = read(reading, style, w, mesh.box);
  moving.motion.mesh = id;
  mesh.speed = std::max(mesh.speed, moving.speed);
  reading.motions.put(fix.id, moving.motion);
}

void move_meshes(Reading& reading, double duration)
{
  for (const auto& [id, motion] : reading.motions) {
    Mesh& mesh = reading.meshes.at(motion.mesh);
    mesh.box.include(sweep(mesh.box, motion, duration));
    for (const std::size_t k : mesh.walls) {
      Wall& wall = reading.scene.walls[k];
      wall.box.include(mesh.box);
      wall.speed = std::max(wall.speed, mesh.speed);
    }
  }
}

}  // namespace granulaw::deck
