#include "deck/scene.hpp"

#include "base/error.hpp"
#include "deck/commands/table.hpp"
#include "deck/script.hpp"

namespace granulaw::deck {

namespace {

/// From the deck's units.
void to_si(Scene& scene)
{
  if (scene.units == "si") return;
  if (scene.units != "cgs")
    fail(scene.deck, "its units cannot be planned with (LIGGGHTS's own, where a deck says none, are lj)",
         "units " + scene.units, "units si, units cgs");
  constexpr double length = 0.01, density = 1000, pressure = 0.1;
  const auto scale = [](Box& box) {
    box.low = length * box.low;
    box.high = length * box.high;
  };
  scene.gravity = length * scene.gravity;
  scale(scene.domain);
  for (auto& [type, m] : scene.materials) {
    if (m.youngs_modulus) *m.youngs_modulus *= pressure;
    if (m.yield_stress) *m.yield_stress *= pressure;
  }
  for (Source& s : scene.sources) {
    for (double* value : {&s.radius_min, &s.radius_max, &s.speed}) *value *= length;
    s.density *= density;
    scale(s.centres);
    for (Vec3& p : s.together) p = length * p;
  }
  for (Wall& wall : scene.walls) {
    for (double* value : {&wall.speed, &wall.drag_speed}) *value *= length;
    scale(wall.box);
  }
}

}  // namespace

double Scene::count() const
{
  double sum = 0;
  for (const Source& s : sources) sum += s.count;
  return sum;
}

Scene read_scene(const std::string& deck, const Presets& presets)
{
  Reading reading;
  const auto state = [&](std::string_view name) -> std::optional<double> {
    if (name == "step") return reading.steps;
    if (name == "dt") return reading.time_step;
    return {};
  };
  Script script([&](const Command& command) { follow(reading, command); }, state);
  reading.note = [&](const std::string& where, const std::string& what) { script.note(where, what); };
  for (const auto& [name, values] : presets) script.preset(name, values);
  script.read(deck);

  Scene scene = reading.scene;
  scene.deck = deck;
  scene.notes = script.notes();
  scene.time_step = reading.time_step;
  to_si(scene);
  return scene;
}

}  // namespace granulaw::deck
