#include "deck/commands/meshes.hpp"

#include <algorithm>
#include <cmath>

#include "deck/commands/reading.hpp"
#include "deck/mesh_file.hpp"

namespace granulaw::deck {

namespace {

/// `rotate axis X Y Z angle DEGREES`
void rotate(Words& w, std::vector<Vec3>& points)
{
  if (!w.take("axis")) misread("'axis' must follow 'rotate'");
  const Vec3 axis = w.vector();
  if (!w.take("angle")) misread("'angle' must follow the axis");
  const double angle = w.value();
  for (Vec3& p : points) p = rotated(p, axis, angle);
}

/// `surface_ang_vel origin X Y Z axis X Y Z omega W`: the largest speed of a point about the origin.
double turning_speed(Words& w, const std::vector<Vec3>& points)
{
  if (!w.take("origin")) misread("'origin' must follow 'surface_ang_vel'");
  const Vec3 origin = w.vector();
  double farthest = 0, omega = 0;
  for (const Vec3& p : points) farthest = std::max(farthest, norm(p - origin));
  if (auto rest = w.after("omega")) omega = std::abs(rest->value());
  return omega * farthest;
}

}  // namespace

void follow_mesh(Reading& reading, const Fix& fix, Words w)
{
  Mesh mesh;
  mesh.where = w.where();
  std::vector<Vec3> points;
  // scale, move and rotate act in the order of the line
  while (w.more()) {
    const std::string& word = w.word();
    if (word == "file") {
      points = mesh_vertices(w.path());
    } else if (word == "type") {
      mesh.type = w.atom_type();
    } else if (word == "scale") {
      const double factor = w.value();
      for (Vec3& p : points) p = factor * p;
    } else if (word == "move") {
      const Vec3 by = w.vector();
      for (Vec3& p : points) p = p + by;
    } else if (word == "rotate") {
      rotate(w, points);
    } else if (word == "surface_vel") {
      mesh.drag_speed = norm(w.vector());
    } else if (word == "surface_ang_vel") {
      mesh.drag_speed = turning_speed(w, points);
    }
  }
  if (points.empty()) misread("its file is missing");
  for (const Vec3& p : points) mesh.box.include(p);
  reading.meshes.put(fix.id, mesh);
}

}  // namespace granulaw::deck
