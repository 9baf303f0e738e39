#include "deck/commands/settings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

void follow_atom_style(Reading& reading, Words w)
{
  const std::string style = w.word();
  if (style != "granular" && style != "sphere")
    reading.scene.unknown_particles.push_back(
        fmt::format("{}: atom_style {}: only spheres are understood", w.where(), style));
}

void follow_boundary(Reading& reading, Words w)
{
  for (bool& wraps : reading.scene.periodic) wraps = w.word() == "p";
}

void follow_create_box(Reading& reading, Words w)
{
  reading.scene.types = static_cast<int>(w.count());
  reading.scene.domain = reading.regions.at(w.word()).box;
}

void follow_lattice(Reading& reading, Words w)
{
  w.word();  // style
  reading.lattice_volume = std::pow(w.value(), 3);
}

void follow_timestep(Reading& reading, Words w)
{
  const double time_step = w.value();
  if (time_step <= 0) misread("a time step must be positive");
  reading.time_step = time_step;
}

void follow_units(Reading& reading, Words w)
{
  reading.scene.units = w.word();
}

void refuse_clear(Reading&, Words)
{
  misread("what came before it is kept");
}

void follow_gravity(Reading& reading, const Fix&, Words w)
{
  const double g = w.value();
  if (!w.take("vector")) misread("only 'gravity G vector x y z' is followed");
  const Vec3 direction = w.vector();
  if (norm(direction) == 0) misread("its vector is 0");
  reading.scene.gravity = g / norm(direction) * direction;
}

}  // namespace granulaw::deck
