#include "deck/commands/walls.hpp"

#include <array>
#include <cmath>

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

/// `mesh n_meshes N meshes ID...`: a wall of each of them.
void add_meshes(Reading& reading, Words w, bool deformable)
{
  std::size_t n = 1;
  if (auto number = w.after("n_meshes")) n = number->count();
  for (Words ids = w.behind("meshes"); n > 0; --n) {
    const std::string id = ids.word();
    Mesh& mesh = reading.meshes.at(id);
    mesh.walls.push_back(reading.scene.walls.size());
    reading.scene.walls.push_back(
        {mesh.where, id, mesh.type, mesh.box, mesh.speed, mesh.drag_speed, deformable});
  }
}

/// `xplane X`, and so on.
bool place_plane(const Words& w, Box& box)
{
  static constexpr std::array<std::string_view, 3> planes{"xplane", "yplane", "zplane"};
  bool found = false;
  for (std::size_t k = 0; k < 3; ++k)
    if (auto plane = w.after(planes[k])) {
      box.low[k] = box.high[k] = plane->value();
      found = true;
    }
  return found;
}

/// `xcylinder RADIUS C1 C2`, and so on.
bool place_cylinder(const Words& w, Box& box)
{
  static constexpr std::array<std::string_view, 3> cylinders{"xcylinder", "ycylinder", "zcylinder"};
  bool found = false;
  for (std::size_t k = 0; k < 3; ++k)
    if (auto cylinder = w.after(cylinders[k])) {
      const double radius = cylinder->value();
      for (std::size_t across = 0; across < 3; ++across) {
        if (across == k) continue;
        const double centre = cylinder->value();
        box.low[across] = centre - radius;
        box.high[across] = centre + radius;
      }
      found = true;
    }
  return found;
}

/// `primitive type T STYLE ... [shear DIMENSION SPEED]`
void add_primitive(Reading& reading, const std::string& id, Words w, bool deformable)
{
  Wall wall{w.where(), id, 1, reading.scene.domain, 0, 0, deformable};
  if (auto type = w.after("type")) wall.type = type->atom_type();
  const bool is_plane = place_plane(w, wall.box), is_cylinder = place_cylinder(w, wall.box);
  if (!is_plane && !is_cylinder) misread("only planes and cylinders are understood as primitives");
  if (auto shear = w.after("shear")) {
    shear->word();
    wall.drag_speed = std::abs(shear->value());
  }
  reading.scene.walls.push_back(wall);
}

}  // namespace

void follow_wall(Reading& reading, const Fix& fix, Words w)
{
  auto own = w.after("wall");
  const bool deformable = own && own->word() == "deformable";
  if (const auto meshes = w.after("mesh"))
    add_meshes(reading, *meshes, deformable);
  else if (const auto primitive = w.after("primitive"))
    add_primitive(reading, fix.id, *primitive, deformable);
  else
    misread("neither 'mesh' nor 'primitive'");
}

void refuse_wall(Reading&, const Fix&, Words)
{
  misread("only wall/gran is read");
}

}  // namespace granulaw::deck
