#pragma once

#include <nlohmann/json.hpp>

#include "liggghts_plugin/plan/scene.hpp"

// The JSON of a scene (scene.hpp): a key for each member, by its name.

/// None is null.
template <class T>
struct nlohmann::adl_serializer<std::optional<T>>
{
  static void to_json(json& j, const std::optional<T>& value) { j = value ? json(*value) : json(); }
  static void from_json(const json& j, std::optional<T>& value) { value = j.is_null() ? std::nullopt : std::optional(j.get<T>()); }
};

namespace granulaw {

/// An infinite side is null.
inline void to_json(nlohmann::json& j, const Box& box)
{
  j = {{"low", box.low}, {"high", box.high}};
}

inline void from_json(const nlohmann::json& j, Box& box)
{
  for (std::size_t k = 0; k < 3; ++k) {
    if (!j["low"][k].is_null()) box.low[k] = j["low"][k];
    if (!j["high"][k].is_null()) box.high[k] = j["high"][k];
  }
}

namespace deck {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TypeMaterial, youngs_modulus, poisson_ratio, yield_stress)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Source, where, type, radius_min, radius_max, density, centres, speed, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Wall, where, id, type, box, speed, drag_speed, deformable, model, push_speed, level_push_speed, lift)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Run, where, steps, time_step, particles, integrates)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DeckCommand, file, line, words)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Scene, units, gravity, domain, periodic, dimension, types, materials, sources, walls, runs, time_step,
                                   model, law_file, material_names, confinement, solid_volume, stretch, restart_stretch, yield_pressure, friction, restitution,
                                   left_loop, stopped_at, notes, unknown_particles, unknown_speeds, commands, files_read, files_written)

}  // namespace deck
}  // namespace granulaw
