#include "deck_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "characterise/body/law_material.hpp"
#include "deck/digits.hpp"
#include "deck/laws_at_hand.hpp"
#include "deck/material_names.hpp"
#include "law/law_file.hpp"
#include "material_file/materials_file.hpp"
#include "option_checks.hpp"
#include "own_files.hpp"

namespace granulaw {

namespace {

using KnownMaterials = std::map<std::string, LawMaterial>;

/// Properties of this material that the law of a plan leaves out; empty: none.
std::string left_out(const Material& m)
{
  std::string what;
  if (!m.hardening.name.empty()) what = fmt::format("its hardening '{}'", m.hardening.name);
  if (!m.rate.name.empty()) what += fmt::format("{}its rate dependence '{}'", what.empty() ? "" : " and ", m.rate.name);
  return what;
}

/// Materials, and particles as spheres of the material of their body. Adds to the notes what a plan leaves
/// out.
KnownMaterials materials_of(const MaterialsFile& file, const std::vector<std::string>& names, std::vector<std::string>& notes)
{
  KnownMaterials known;
  for (const auto& [name, particle] : file.particles) known[name] = law_material(name, particle.materials[0]);
  for (const auto& [name, m] : file.materials) known[name] = law_material(name, m);
  for (const std::string& name : names) {
    const bool is_particle = file.means_particle(name);
    if (is_particle && !file.particle(name).is_homogeneous_sphere())
      notes.push_back(fmt::format("{}: '{}' is planned as a homogeneous sphere of its body's material", file.source, name));
    if (!known.contains(name)) continue;
    const Material& m = is_particle ? file.particle(name).materials[0] : file.material(name);
    if (const std::string what = left_out(m); !what.empty())
      notes.push_back(fmt::format("{}: '{}' is planned without {}: overlaps are upper bounds", file.source, name, what));
  }
  return known;
}

/// The materials of the materials file, else of the deck's law; none if there is neither.
deck::NamedMaterials known_materials(const DeckOptions& o, const Law* law, deck::Scene& scene)
{
  const std::vector<std::string>& names = o.materials.empty() ? scene.material_names : o.materials;
  if (!o.materials_file.empty()) return {o.materials_file, materials_of(read_materials(o.materials_file), names, scene.notes)};
  if (law) {
    deck::NamedMaterials of_law{scene.law_file, {}};
    for (const auto& [name, body] : law->bodies) of_law.known[name] = body.material;
    return of_law;
  }
  if (!o.materials.empty()) fail("--materials", "names need the file that they are in", "", "--materials-file FILE");
  return {};
}

}  // namespace

void DeckOptions::add_to(Options& command, bool own_materials, Option needed)
{
  const std::size_t before = command.size();
  command.add_option("--var", variables, "NAME VALUE: a variable of the deck, as liggghts -var; several times").pairs_of_words();
  if (own_materials) command.add_option("--materials-file", materials_file, "MATERIALS.toml: yield stresses and hardening");
  command
      .add_option(
          "--materials", materials, "names of its materials, one for each atom type in their order (default: the words after 'materials'\nin the deck's pair_style)")
      .list();
  command.add_option("--drop-height", drop_height, "m, from which every particle falls to the lowest wall").check(above_zero());
  command.add_option("--radius", radius, "R or R_MIN R_MAX, m, of particles that the deck does not show").expected(1, 2).list().check(above_zero());
  command.add_option("--density", density, "kg/m^3, of the same").check(above_zero());
  command.add_option("--speed", speed, "m/s, the largest approach speed of any two bodies").check(above_zero());
  command.add_option("--particles", particles, "how many there are, for the cost").check(above_zero());
  command.add_option("--rate", rate, "particle-steps a second, for the cost (default: one core, dense hopper)").check(above_zero()).capture_default_str();
  command.add_option("--from", visited, "JSON of fix granulaw/stats: what a run of this deck visited replaces what is foreseen, with a margin of 1.25");
  if (!needed) return;
  for (Option& own : command.from(before)) own.needs(needed);
}

deck::Presets DeckOptions::presets() const
{
  deck::Presets result;
  for (std::size_t k = 0; k + 1 < variables.size(); k += 2) result.push_back({variables[k], {variables[k + 1]}});
  return result;
}

PlannedDeck plan_deck(const std::string& path, const DeckOptions& o) { return plan_scene(deck::read_scene(path, o.presets()), o); }

PlannedDeck plan_scene(deck::Scene scene, const DeckOptions& o)
{
  PlannedDeck result;
  result.scene = std::move(scene);
  deck::PlanOptions& p = result.options;
  const auto given = [](double value) { return value > 0 ? std::optional<double>(value) : std::nullopt; };
  p.drop_height = given(o.drop_height), p.speed = given(o.speed), p.density = given(o.density);
  p.particles = given(o.particles);
  if (!o.radius.empty()) {
    p.radius_min = o.radius.front(), p.radius_max = o.radius.back();
    if (*p.radius_min > *p.radius_max) std::swap(*p.radius_min, *p.radius_max);
  }
  p.rate = o.rate;
  std::optional<Law> law;  // a materials file goes before it: it may be of other materials by now
  if (o.materials_file.empty() && !result.scene.law_file.empty() && std::ifstream(result.scene.law_file)) law = read_law(result.scene.law_file);
  deck::name_materials(p, result.scene, known_materials(o, law ? &*law : nullptr, result.scene), o.materials, !o.materials_file.empty());
  deck::set_contact_law(p, result.scene, std::move(law), own_atlas());
  std::optional<deck::Visited> visited;
  if (!o.visited.empty()) visited = deck::read_visited(o.visited);
  result.plan = deck::make_plan(result.scene, p, visited ? &*visited : nullptr);
  return result;
}

std::string questions_text(const deck::Plan& plan)
{
  std::string text;
  for (const deck::Question& q : plan.questions) text += fmt::format("  {}: give it by {}\n", printable(q.what), q.option);
  return text;
}

void require_answers(const deck::Plan& plan, const std::string& deck)
{
  for (const deck::Question& q : plan.questions)
    if (q.option != "--particles N") fail(deck, fmt::format("not in the deck: {}: give it by {}", q.what, q.option));
}

std::string step_text(double time_step) { return fmt::format("{:.3g}", deck::rounded_down(time_step, 3)); }

}  // namespace granulaw
