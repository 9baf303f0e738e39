#pragma once

#include "scratch_folder.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

using Deck = ScratchFolder;

/// A wall across z.
inline Wall floor_at(double z, int type = 2)
{
  return {"in.deck:7", "w", type, {{-1, -1, z}, {1, 1, z}}, 0, 0, false, "hertz"};
}

/// 100 spheres of 2 mm that fall from at most 0.2 m, at 0.5 m/s at first.
inline Scene falling()
{
  Scene s;
  s.deck = "in.deck";
  s.units = "si";
  s.gravity = {0, 0, -9.81};
  s.domain = {{-1, -1, 0}, {1, 1, 1}};
  s.types = 2;
  s.materials[1] = {91e6, 0.3, {}};
  s.materials[2] = {210e9, 0.3, {}};
  s.model = "hertz";
  s.time_step = 1e-5;
  Source spheres;
  spheres.where = "in.deck:10";
  spheres.radius_min = spheres.radius_max = 0.002;
  spheres.density = 1000;
  spheres.centres = {{-0.05, -0.05, 0.1}, {0.05, 0.05, 0.2}};
  spheres.speed = 0.5;
  spheres.count = 100;
  s.sources = {spheres};
  s.walls = {floor_at(0)};
  s.runs = {{"in.deck:11", 1000, 1e-5, 50}};
  return s;
}

}  // namespace granulaw::deck
