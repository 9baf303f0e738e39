#include "deck/atom_types.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "deck/plan_options.hpp"

namespace granulaw::deck {

namespace {

constexpr const char *radius_option = "--radius R [R_MAX]", *density_option = "--density RHO", *material_option = "--materials-file FILE --materials NAME...";

/// Its material by the name that the options know, else by the deck's own properties.
void set_material(AtomType& t, const Scene& scene, const PlanOptions& options)
{
  if (const auto named = options.materials.find(t.type); named != options.materials.end()) {
    t.material = named->second;
    t.known_yield = true;
    if (t.material.density == 0) t.material.density = t.density;
    return;
  }
  t.material.name = fmt::format("type{}", t.type);
  t.material.density = t.density;
  const auto given = scene.materials.find(t.type);
  if (given == scene.materials.end() || !given->second.has_moduli()) return;
  t.material.youngs_modulus = *given->second.youngs_modulus;
  t.material.poisson_ratio = *given->second.poisson_ratio;
  t.material.yield_stress = given->second.yield_stress.value_or(t.material.yield_stress);
  t.known_yield = given->second.yield_stress.has_value();
}

/// True if its moduli are known; adds the questions if not.
bool has_moduli(const AtomType& t, std::vector<Question>& questions)
{
  if (t.material.youngs_modulus > 0) return true;
  ask(questions, fmt::format("the moduli of type {}", t.type), material_option);
  return false;
}

/// The deck's sources; of a deck without any, one of type 1 that the options describe.
std::vector<Source> sources_of(const Scene& scene, const PlanOptions& options, std::vector<Question>& questions)
{
  if (!scene.sources.empty()) return scene.sources;
  if (!options.radius_max && scene.unknown_particles.empty()) ask(questions, scene.deck + ": no particles were understood", radius_option);
  Source unknown;
  unknown.where = scene.deck;
  return {unknown};
}

/// Size and density of the source's particles from the options where the deck does not say them.
void complete(Source& s, const PlanOptions& options)
{
  if (s.radius_max <= 0) {
    s.radius_min = options.radius_min.value_or(0);
    s.radius_max = options.radius_max.value_or(0);
  }
  if (s.density <= 0) s.density = options.density.value_or(0);
  if (const auto m = options.materials.find(s.type); s.density <= 0 && m != options.materials.end()) s.density = m->second.density;
}

/// True if size and density are known; adds the questions if not.
bool is_complete(const Source& s, const Scene& scene, std::vector<Question>& questions)
{
  if (s.radius_max <= 0) {
    if (!scene.sources.empty()) ask(questions, s.where + ": the radius of its particles", radius_option);
    return false;
  }
  if (s.density <= 0) ask(questions, s.where + ": the density of its particles", density_option);
  return s.density > 0;
}

void add(std::map<int, AtomType>& types, const Source& s)
{
  const auto [found, is_new] = types.try_emplace(s.type);
  AtomType& t = found->second;
  t.type = s.type;
  t.radius_min = is_new ? s.radius_min : std::min(t.radius_min, s.radius_min);
  t.radius_max = std::max(t.radius_max, s.radius_max);
  t.density = std::max(t.density, s.density);
}

/// The radii that are given stand for particles that the deck hides.
void include_hidden(std::map<int, AtomType>& types, const Scene& scene, const PlanOptions& options, std::vector<Question>& questions)
{
  if (scene.unknown_particles.empty()) return;
  if (!options.radius_max) return ask(questions, first_of(scene.unknown_particles), radius_option);
  for (auto& [type, t] : types) {
    t.radius_min = std::min(t.radius_min, *options.radius_min);
    t.radius_max = std::max(t.radius_max, *options.radius_max);
  }
}

}  // namespace

std::map<int, AtomType> particle_types(const Scene& scene, const PlanOptions& options, std::vector<Question>& questions)
{
  std::map<int, AtomType> types;
  for (Source s : sources_of(scene, options, questions)) {
    complete(s, options);
    if (is_complete(s, scene, questions)) add(types, s);
  }
  include_hidden(types, scene, options, questions);
  for (auto& [type, t] : types) set_material(t, scene, options);
  std::erase_if(types, [&](const auto& entry) { return !has_moduli(entry.second, questions); });
  return types;
}

std::optional<AtomType> wall_type(const Scene& scene, int type, const PlanOptions& options, std::vector<Question>& questions)
{
  AtomType t;
  t.type = type;
  set_material(t, scene, options);
  return has_moduli(t, questions) ? std::optional(t) : std::nullopt;
}

}  // namespace granulaw::deck
