#include "deck_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "characterise/law_from_atlas.hpp"
#include "characterise/law_material.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "materials_file.hpp"
#include "option_checks.hpp"

namespace granulaw {

namespace {

using KnownMaterials = std::map<std::string, LawMaterial>;

/// Throws Error for a name of --materials that the file lacks, unless the deck itself describes its type.
void check_given(const DeckOptions& o, const deck::Scene& scene, const MaterialsFile& file)
{
  for (std::size_t k = 0; k < o.materials.size(); ++k)
    if (!scene.materials.contains(static_cast<int>(k) + 1)) file.material(o.materials[k]);
}

/// The materials of the materials file, else of the deck's law file; none if there is neither.
KnownMaterials known_materials(const DeckOptions& o, const deck::Scene& scene)
{
  KnownMaterials known;
  if (!o.materials_file.empty()) {
    const MaterialsFile file = read_materials(o.materials_file);
    check_given(o, scene, file);
    for (const auto& [name, m] : file.materials) known[name] = law_material(name, m);
  } else if (!scene.law_file.empty() && std::ifstream(scene.law_file)) {
    const Law law = read_law(scene.law_file);
    for (const auto& [name, body] : law.bodies) known[name] = body.material;
  } else if (!o.materials.empty()) {
    fail("--materials", "names need the file that they are in", "", "--materials-file FILE");
  }
  return known;
}

/// The material of an atom type as the deck describes it, elastic; none if it does not.
std::optional<LawMaterial> material_by_deck(const std::string& name, int type, const deck::Scene& scene)
{
  const auto found = scene.materials.find(type);
  if (found == scene.materials.end() || !found->second.youngs_modulus) return std::nullopt;
  LawMaterial m;
  m.name = name;
  m.youngs_modulus = *found->second.youngs_modulus;
  m.poisson_ratio = found->second.poisson_ratio.value_or(0);
  for (const deck::Source& s : scene.sources)
    if (s.type == type) m.density = s.density;
  return m;
}

/// Materials of the atom types by the names that --materials or the deck's pair_style gives them. A name that
/// the file does not hold stays as the deck describes it, elastic: a wall's, or an elastic partner's.
void name_materials(deck::PlanOptions& into, const deck::Scene& scene, const DeckOptions& o)
{
  const bool given = !o.materials.empty();
  const std::vector<std::string>& names = given ? o.materials : scene.material_names;
  const KnownMaterials known = known_materials(o, scene);
  // one material, one type: there is nothing to name
  if (!o.materials_file.empty() && names.empty() && known.size() == 1 && scene.types <= 1)
    into.materials[1] = known.begin()->second;
  bool any = false;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const int type = static_cast<int>(k) + 1;
    if (const auto m = known.find(names[k]); m != known.end()) {
      into.materials[type] = m->second;
      any = true;
    } else if (!known.empty()) {
      if (const auto by_deck = material_by_deck(names[k], type, scene)) into.materials[type] = *by_deck;
    }
  }
  if (given && !any)
    fail("--materials", fmt::format("none of them is in {}", o.materials_file),
         fmt::format("'{}'", names[0]));
}

/// Collisions by the atlas's laws; each law is made once.
deck::Collide collide_by_atlas()
{
  const auto atlas = std::make_shared<const std::optional<Atlas>>(own_atlas());
  if (!*atlas) return {};
  const auto laws = std::make_shared<std::map<std::string, std::optional<BodyLaw>>>();
  return [atlas, laws](const deck::Meeting& m, double r_eff, double m_eff,
                       double speed) -> std::optional<deck::Collision> {
    const LawMaterial& material = m.yields;
    const std::string key =
        fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", material.youngs_modulus, material.poisson_ratio,
                    material.yield_stress, material.hardening_modulus);
    if (!laws->contains(key)) {
      std::optional<BodyLaw>& law = (*laws)[key];
      if (!material.yields() || (*atlas)->why_not(MaterialRatios::of(material)).empty()) {
        BuildOptions options;
        options.depth = 0.5, options.fastest = 0.3;
        law = law_from(**atlas, material, options);
      }
    }
    const std::optional<BodyLaw>& law = laws->at(key);
    if (!law) return {};
    const PairLaw pair{&law->curve, m.mapping, &*law};
    const Replay replay = replay_collision(pair, r_eff, m_eff, speed, 2000);
    // past the table the force is extrapolated: still an answer about depth, capped by whoever builds
    return deck::Collision{replay.delta_max / m.mapping.length(r_eff), replay.restitution};
  };
}

}  // namespace

void DeckOptions::add_to(CLI::App& command, bool own_materials, CLI::Option* needed)
{
  const std::size_t before = command.get_options().size();
  command
      .add_option("--var", variables, "NAME VALUE: a variable of the deck, as liggghts -var; several times")
      ->type_size(2)
      ->expected(1, 1000);
  if (own_materials)
    command.add_option("--materials-file", materials_file, "MATERIALS.toml: yield stresses and hardening");
  command.add_option(
      "--materials", materials,
      "names of its materials, one for each atom type in their order (default: the words after "
      "'materials'\nin the deck's pair_style)");
  command.add_option("--drop-height", drop_height, "m, from which every particle falls to the lowest wall")
      ->check(above_zero());
  command.add_option("--radius", radius, "R or R_MIN R_MAX, m, of particles that the deck does not show")
      ->expected(1, 2)
      ->check(above_zero());
  command.add_option("--density", density, "kg/m^3, of the same")->check(above_zero());
  command.add_option("--speed", speed, "m/s, the largest approach speed of any two bodies")
      ->check(above_zero());
  command.add_option("--particles", particles, "how many there are, for the cost")->check(above_zero());
  command
      .add_option("--rate", rate, "particle-steps a second, for the cost (default: one core, dense hopper)")
      ->check(above_zero())
      ->capture_default_str();
  command.add_option(
      "--from", visited,
      "JSON of fix granulaw/stats: what a run of this deck visited replaces what is foreseen, with a "
      "margin of 1.25");
  if (!needed) return;
  const auto options = command.get_options();
  for (std::size_t k = before; k < options.size(); ++k) options[k]->needs(needed);
}

PlannedDeck plan_deck(const std::string& path, const DeckOptions& o)
{
  PlannedDeck result;
  deck::Presets presets;
  for (std::size_t k = 0; k + 1 < o.variables.size(); k += 2)
    presets.push_back({o.variables[k], {o.variables[k + 1]}});
  result.scene = deck::read_scene(path, presets);
  deck::PlanOptions& p = result.options;
  const auto given = [](double value) { return value > 0 ? std::optional<double>(value) : std::nullopt; };
  p.drop_height = given(o.drop_height), p.speed = given(o.speed), p.density = given(o.density);
  p.particles = given(o.particles);
  if (!o.radius.empty()) {
    p.radius_min = o.radius.front(), p.radius_max = o.radius.back();
    if (*p.radius_min > *p.radius_max) std::swap(*p.radius_min, *p.radius_max);
  }
  p.rate = o.rate;
  name_materials(p, result.scene, o);
  p.collide = collide_by_atlas();
  std::optional<deck::Visited> visited;
  if (!o.visited.empty()) visited = deck::read_visited(o.visited);
  result.plan = deck::make_plan(result.scene, p, visited ? &*visited : nullptr);
  return result;
}

std::string questions_text(const deck::Plan& plan)
{
  std::string text;
  for (const deck::Question& q : plan.questions)
    text += fmt::format("  {}: give it by {}\n", printable(q.what), q.option);
  return text;
}

void require_answers(const deck::Plan& plan, const std::string& deck)
{
  for (const deck::Question& q : plan.questions)
    if (q.option != "--particles N")
      fail(deck, fmt::format("not in the deck: {}: give it by {}", q.what, q.option));
}

std::string types_text(const deck::Meeting& meeting)
{
  return fmt::format("{}:{}{}", meeting.a, meeting.wall ? "wall " : "", meeting.b);
}

}  // namespace granulaw
