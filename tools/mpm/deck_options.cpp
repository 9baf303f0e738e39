#include "deck_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <set>

#include "atlas_path.hpp"
#include "base/error.hpp"
#include "atlas/law_from_atlas.hpp"
#include "characterise/body/law_material.hpp"
#include "deck/hertz.hpp"
#include "law/contact_step.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "liggghts_plugin/contact/mpm_physics.hpp"
#include "materials_file.hpp"
#include "option_checks.hpp"

namespace granulaw {

namespace {

using KnownMaterials = std::map<std::string, LawMaterial>;

/// Properties of this material that the law of a plan leaves out; empty: none.
std::string left_out(const Material& m)
{
  std::string what;
  if (!m.hardening.name.empty()) what = fmt::format("its hardening '{}'", m.hardening.name);
  if (!m.rate.name.empty())
    what += fmt::format("{}its rate dependence '{}'", what.empty() ? "" : " and ", m.rate.name);
  return what;
}

/// Materials, and particles as spheres of the material of their body. Adds to the notes what a plan leaves
/// out.
KnownMaterials materials_of(const MaterialsFile& file, const std::vector<std::string>& names,
                            std::vector<std::string>& notes)
{
  KnownMaterials known;
  for (const auto& [name, particle] : file.particles) known[name] = law_material(name, particle.materials[0]);
  for (const auto& [name, m] : file.materials) known[name] = law_material(name, m);
  for (const std::string& name : names) {
    const bool is_particle = file.means_particle(name);
    if (is_particle && !file.particle(name).is_homogeneous_sphere())
      notes.push_back(fmt::format("{}: '{}' is planned as a homogeneous sphere of its body's material",
                                  file.source, name));
    if (!known.contains(name)) continue;
    const Material& m = is_particle ? file.particle(name).materials[0] : file.material(name);
    if (const std::string what = left_out(m); !what.empty())
      notes.push_back(
          fmt::format("{}: '{}' is planned without {}: overlaps are upper bounds", file.source, name, what));
  }
  return known;
}

/// The atom types whose bodies deform: particles, and walls that the deck calls deformable.
std::set<int> deforming_types(const deck::Scene& scene)
{
  std::set<int> types;
  for (const deck::Source& s : scene.sources) types.insert(s.type);
  if (types.empty()) types.insert(1);  // the plan's particles where the deck shows none
  for (const deck::Wall& w : scene.walls)
    if (w.deformable) types.insert(w.type);
  return types;
}

/// The material of an atom type as the deck describes it, elastic; none if it does not.
std::optional<LawMaterial> material_by_deck(const std::string& name, int type, const deck::Scene& scene)
{
  const auto found = scene.materials.find(type);
  if (found == scene.materials.end() || !found->second.has_moduli()) return std::nullopt;
  LawMaterial m;
  m.name = name;
  m.youngs_modulus = *found->second.youngs_modulus;
  m.poisson_ratio = *found->second.poisson_ratio;
  for (const deck::Source& s : scene.sources)
    if (s.type == type) m.density = s.density;
  return m;
}

/// A file that names materials, and they.
struct NamedMaterials
{
  std::string path;
  KnownMaterials known;
};

/// The materials of the materials file, else of the deck's law; none if there is neither.
NamedMaterials known_materials(const DeckOptions& o, const std::vector<std::string>& names, const Law* law,
                               deck::Scene& scene)
{
  if (!o.materials_file.empty())
    return {o.materials_file, materials_of(read_materials(o.materials_file), names, scene.notes)};
  if (law) {
    NamedMaterials of_law{scene.law_file, {}};
    for (const auto& [name, body] : law->bodies) of_law.known[name] = body.material;
    return of_law;
  }
  if (!o.materials.empty())
    fail("--materials", "names need the file that they are in", "", "--materials-file FILE");
  return {};
}

/// Materials of the atom types by the names that --materials or the deck's pair_style gives them. A name that
/// the file lacks stays as the deck describes it where its type has walls only, which are rigid, and where it
/// is the plug-in's own `elastic`. Throws Error for any other.
void name_materials(deck::PlanOptions& into, deck::Scene& scene, const DeckOptions& o, const Law* law)
{
  const bool given = !o.materials.empty();
  const std::vector<std::string>& names = given ? o.materials : scene.material_names;
  const auto [path, known] = known_materials(o, names, law, scene);
  // one material, one type: there is nothing to name
  if (!o.materials_file.empty() && names.empty() && known.size() == 1 && scene.types <= 1)
    into.materials[1] = known.begin()->second;
  if (known.empty()) return;
  const std::string who = given ? "--materials" : fmt::format("{}: 'materials' of pair_style", scene.deck);
  if (scene.types > 0 && names.size() > static_cast<std::size_t>(scene.types))
    fail(who, fmt::format("more names than the deck's {} atom types", scene.types),
         fmt::format("{}", fmt::join(names, " ")));
  const std::set<int> deforming = deforming_types(scene);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const int type = static_cast<int>(k) + 1;
    if (const auto m = known.find(names[k]); m != known.end()) {
      into.materials[type] = m->second;
      continue;
    }
    const auto by_deck = material_by_deck(names[k], type, scene);
    if (names[k] != plugin::elastic_name && deforming.contains(type))
      fail_unknown(who, fmt::format("{} has no material for atom type {}", path, type), names[k],
                   names_of(known));
    if (by_deck) into.materials[type] = *by_deck;
  }
}

/// True if a law that was made for `a` is the law of `b`.
bool is_same_material(const LawMaterial& a, const LawMaterial& b)
{
  return a.youngs_modulus == b.youngs_modulus && a.poisson_ratio == b.poisson_ratio &&
         a.yield_stress == b.yield_stress && a.hardening_modulus == b.hardening_modulus;
}

/// The laws at hand for a plan: the deck's own, if it is of the body that yields, else the atlas's.
class LawsAtHand
{
 public:
  LawsAtHand(std::optional<Law> deck_law, std::optional<Atlas> atlas)
      : deck_law_(std::move(deck_law)), atlas_(std::move(atlas))
  {
  }

  std::optional<deck::Collision> collide(const deck::Meeting& m, double r_eff, double m_eff, double speed)
  {
    if (follows_hertz(m)) return {};
    for (const bool own : {true, false})
      if (const auto pair = own ? by_deck(m, 1, m.wall ? Box::infinity : 1) : by_atlas(m)) {
        const Replay replay = replay_collision(*pair, r_eff, m_eff, speed, 2000);
        if (own && replay.left_range) continue;
        // past the table the force is extrapolated: still an answer about depth, capped by whoever builds
        return deck::Collision{replay.delta_max / m.mapping.length(r_eff), replay.restitution};
      }
    return {};
  }

  std::optional<double> stiffness(const deck::Meeting& m, double radius_a, double radius_b, double r_eff,
                                  double overlap)
  {
    if (follows_hertz(m)) return {};
    for (const bool own : {true, false})
      if (const auto pair = own ? by_deck(m, radius_a, radius_b) : by_atlas(m)) {
        if (own && overlap > pair->max_overlap(r_eff)) continue;
        return planned_stiffness(*pair, r_eff, overlap);
      }
    return {};
  }

 private:
  /// As the plug-in does for types that the deck calls `elastic`.
  static bool follows_hertz(const deck::Meeting& m)
  {
    return m.yields.name == plugin::elastic_name && !m.yields.yields();
  }

  /// The law of these radii (m; of a wall infinite), or of their ratio.
  std::optional<PairLaw> by_deck(const deck::Meeting& m, double radius_a, double radius_b) const
  {
    if (!deck_law_) return {};
    const auto yielding = deck_law_->bodies.find(m.yields.name);
    if (yielding == deck_law_->bodies.end() || !is_same_material(yielding->second.material, m.yields))
      return {};
    const bool rigid = m.wall && !m.deformable;
    if (deck_law_->find_pair(m.name_a, rigid ? wall_name : m.name_b))
      return resolve_pair(*deck_law_, m.name_a, rigid ? wall_name : m.name_b, "the deck's law", radius_a,
                          radius_b);
    return PairLaw{{&yielding->second.curve, m.mapping}, &yielding->second};
  }

  /// Each law is made once.
  std::optional<PairLaw> by_atlas(const deck::Meeting& m)
  {
    if (!atlas_) return {};
    const LawMaterial& material = m.yields;
    const std::string key =
        fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", material.youngs_modulus, material.poisson_ratio,
                    material.yield_stress, material.hardening_modulus);
    const auto [found, is_new] = made_.try_emplace(key);
    if (is_new && (!material.yields() || atlas_->why_not(MaterialRatios::of(material)).empty())) {
      LawRange options;
      options.depth = 0.5, options.fastest = 0.3;
      found->second = law_from(*atlas_, material, options);
    }
    if (!found->second) return {};
    return PairLaw{{&found->second->curve, m.mapping}, &*found->second};
  }

  std::optional<Law> deck_law_;
  std::optional<Atlas> atlas_;
  std::map<std::string, std::optional<BodyLaw>> made_;  // by numbers of the material
};

/// Thornton's closed form, as model thornton has it.
ThorntonPair thornton_of(const deck::Meeting& m)
{
  return {m.mapping.e_star_pair(), 1.6 * m.yields.yield_stress};
}

std::optional<deck::Collision> collide_by_thornton(const deck::Meeting& m, double r_eff, double m_eff,
                                                   double speed)
{
  const ThorntonPair law = thornton_of(m);
  const double duration = deck::hertz_time(law.e_star, r_eff, m_eff, speed);
  const Replay replay =
      replay_collision([&](double delta, double delta_max) { return law.evaluate(r_eff, delta, delta_max); },
                       m_eff, speed, duration, 2000);
  return deck::Collision{replay.delta_max / m.mapping.length(r_eff), replay.restitution, "Thornton"};
}

/// The law that the deck's contacts follow.
void set_contact_law(deck::PlanOptions& into, const deck::Scene& scene, std::optional<Law> deck_law)
{
  if (scene.model == "thornton") {
    into.collide = collide_by_thornton;
    into.stiffness = [](const deck::Meeting& m, double, double, double r_eff, double overlap) {
      return std::optional(planned_stiffness(thornton_of(m), r_eff, overlap));
    };
    return;
  }
  const auto laws = std::make_shared<LawsAtHand>(std::move(deck_law), own_atlas());
  into.collide = [laws](const auto&... what) { return laws->collide(what...); };
  into.stiffness = [laws](const auto&... what) { return laws->stiffness(what...); };
}

}  // namespace

void DeckOptions::add_to(Options& command, bool own_materials, Option needed)
{
  const std::size_t before = command.size();
  command
      .add_option("--var", variables, "NAME VALUE: a variable of the deck, as liggghts -var; several times")
      ->pairs_of_words();
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
  for (Option& own : command.from(before)) own.needs(needed);
}

PlannedDeck plan_deck(const std::string& path, const DeckOptions& o)
{
  deck::Presets presets;
  for (std::size_t k = 0; k + 1 < o.variables.size(); k += 2)
    presets.push_back({o.variables[k], {o.variables[k + 1]}});
  return plan_scene(deck::read_scene(path, presets), o);
}

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
  if (o.materials_file.empty() && !result.scene.law_file.empty() && std::ifstream(result.scene.law_file))
    law = read_law(result.scene.law_file);
  name_materials(p, result.scene, o, law ? &*law : nullptr);
  set_contact_law(p, result.scene, std::move(law));
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

std::string step_text(double time_step)
{
  const double unit = std::pow(10.0, std::floor(std::log10(time_step)) - 2);
  return fmt::format("{:.3g}", std::floor(time_step / unit * (1 + 1e-12)) * unit);
}

std::string types_text(const deck::Meeting& meeting)
{
  return fmt::format("{}:{}{}", meeting.a, meeting.wall ? "wall " : "", meeting.b);
}

}  // namespace granulaw
